#include "sim/sand_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/stroke_script.h"
#include "sim/simulation.h"
#include "sim/told.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// A hill 30 mm high, at rest.
Scene hill() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.3;
  scene.bed.cols = scene.bed.rows = 150;
  scene.bed.surface.kind = SurfaceKind::cone;
  scene.bed.surface.radius = 0.12;
  scene.bed.surface.height = 0.03;
  scene.relaxation.rate = 0.0;
  return scene;
}

Stroke drag(double depth) {
  Stroke stroke;
  for (int i = 0; i <= 20; ++i) {
    stroke.time.push_back(0.05 * i);
    stroke.position.emplace_back(0.01 * (i - 10), 0.0, -depth);
  }
  stroke.follows_sand = true;
  return stroke;
}

std::vector<TickRecord> ticks_of(const Scene& scene, const Stroke& stroke, RunResult* result = nullptr) {
  Simulation simulation(scene, starting_bed(scene.bed), stroke);
  Told told;
  const RunResult ran = simulation.run({&told});
  if (result) *result = ran;
  return told.ticks;
}

TEST(SandFollower, TheTipIsAsDeepAsAskedOnAHillAsOnTheFlat) {
  Scene scene = hill();
  for (const bool flat : {false, true}) {
    if (flat) scene.bed.surface = {};
    RunResult result;
    double highest = -1.0;
    for (const TickRecord& tick : ticks_of(scene, drag(0.004), &result)) {
      EXPECT_NEAR(tick.depth, 0.004, 1e-15);
      EXPECT_NEAR(tick.level - tick.hand.position.z(), 0.004, 1e-15);
      highest = std::max(highest, tick.device_position.z());
    }
    EXPECT_NEAR(highest, flat ? -0.004 : 0.02, 0.006);  // it went over the hill
    ASSERT_TRUE(result.followed);
    EXPECT_NEAR(result.followed->asked_depth, 0.004, 1e-15);
    EXPECT_NEAR(result.followed->depth, 0.004, 1e-15);
    EXPECT_NEAR(result.followed->force, 1000.0 * std::expm1(0.5 * 0.004), 1e-12);
    EXPECT_NEAR(result.followed->asked_force, result.followed->force, 1e-12);
  }
}

TEST(SandFollower, RelaxingSandIsFollowedWithinATick) {
  Scene scene = hill();
  for (const bool accurate : {false, true}) {
    if (accurate) {
      scene.preset = ModelPreset::accurate;
      apply_model_preset(scene);
    } else {
      scene.relaxation.rate = 60.0;
    }
    RunResult result;
    for (const TickRecord& tick : ticks_of(scene, drag(0.004), &result))
      EXPECT_NEAR(tick.depth, 0.004, 0.0005) << tick.time;
    EXPECT_NEAR(result.followed->depth, 0.004, 4e-5);
  }
}

TEST(SandFollower, ARestingToolCarvesNoShaft) {
  Scene scene = hill();
  scene.bed.surface = {};
  Stroke rest = drag(0.004);
  for (Vector3d& p : rest.position) p.x() = 0.0;
  for (double& t : rest.time) t *= 4.0;
  rest.gap_threshold = 1.0;
  for (const bool accurate : {false, true}) {
    scene.relaxation.rate = 60.0;
    if (accurate) {
      scene.preset = ModelPreset::accurate;
      apply_model_preset(scene);
    }
    const double low = ticks_of(scene, rest).back().device_position.z();
    EXPECT_GT(low, -0.01) << accurate;
    EXPECT_LE(low, -0.004 + 1e-12) << accurate;
  }
}

TEST(SandFollower, AScaledDeviceFollowsInItsOwnMetres) {
  Scene scene = hill();
  scene.device.scale = 2.0;
  scene.device.offset = {0.01, 0.0, -0.001};
  Stroke stroke = drag(0.0);
  for (Vector3d& p : stroke.position) p = {0.5 * p.x(), 0.0, -0.002};
  for (const TickRecord& tick : ticks_of(scene, stroke)) EXPECT_NEAR(tick.depth, 0.005, 1e-15);
}

TEST(SandFollower, ItsVelocityIsThatOfTheWay) {
  const std::vector<TickRecord> ticks = ticks_of(hill(), drag(0.004));
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    const double way = ticks[i].hand.position.z() - ticks[i - 1].hand.position.z();
    EXPECT_NEAR(ticks[i].hand.velocity.z(), 1000.0 * way, 1e-9) << i;
  }
}

TEST(SandFollower, AScriptsForceIsTheForceThatIsFelt) {
  Scene scene = hill();
  scene.force.k_c = 40.0;
  StrokeScript script;
  script.start = {-0.08, 0.0};
  script.clearance = 0.04;
  script.segments.push_back({ScriptLine{{}, {0.08, 0.0}}, {PressProfile::Kind::force, {2.0, 1.0}}, 0.1, 0.0});
  const Stroke stroke = trace_script(script, scene.force);
  EXPECT_TRUE(stroke.follows_sand);
  int drags = 0;
  for (const TickRecord& tick : ticks_of(scene, stroke)) {
    const double x = tick.hand.position.x(), along = (x + 0.08) / 0.16;
    if (along < 0.01 || along > 0.99) continue;
    // The depth is linear between those of the two forces.
    const double depth =
        std::lerp(depth_of_repulse_force(2.0, scene.force), depth_of_repulse_force(1.0, scene.force), along);
    EXPECT_NEAR(tick.repulse_force.z(), repulse_force(depth, scene.force), 1e-9);
    ++drags;
  }
  EXPECT_GT(drags, 1000);
  script.segments[0].press = {PressProfile::Kind::depth, {0.002}};
  EXPECT_FALSE(trace_script(script, scene.force).follows_sand);
}

TEST(SandFollower, BesideTheBedItMayBeInTheAirOnly) {
  Scene scene = hill();
  Stroke stroke = drag(0.004);
  stroke.position.front() = {-0.2, 0.0, 0.001};
  EXPECT_NO_THROW(ticks_of(scene, stroke));
  stroke.position.front().z() = -0.001;
  EXPECT_ANY_THROW(ticks_of(scene, stroke));
}

}  // namespace
}  // namespace sandstroke
