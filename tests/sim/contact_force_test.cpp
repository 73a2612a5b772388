#include "sim/contact_force.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/pressed_tool.h"
#include "sim/simulation.h"
#include "sim/told.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

TEST(ContactForce, LiftOfArchimedesActsAtTheCentroidOfWhatIsInTheSand) {
  Scene box = contact_scene_of(ForceLaw::archimedes, ToolShape::box);
  const double depth = 0.01, pressure = 0.87574 * resistance(box.strength);
  const Wrench upright = pressed(box, depth);
  EXPECT_NEAR(upright.force.z(), pressure * 0.02 * 0.02 * depth, 1e-3 * upright.force.z());
  EXPECT_LT(upright.torque.norm(), 1e-9);
  // A wall that leans over by 90 deg: its tip is at the middle of one end, and it lies along x.
  box.tool.orientation = {0.0, 90.0, 0.0};
  const Wrench lying = pressed(box, depth);
  EXPECT_NEAR(lying.force.z(), pressure * 0.04 * 0.02 * depth, 1e-3 * lying.force.z());
  EXPECT_NEAR(lying.torque.y(), -0.02 * lying.force.z(), 1e-6);
  EXPECT_NEAR(lying.torque.x(), 0.0, 1e-9);
}

TEST(ContactForce, LimitedSandGivesWhatTheDeviceCanAndIsNoStiffer) {
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes}) {
    Scene scene = contact_scene_of(law, ToolShape::cone);
    const Wrench full = pressed(scene, 0.015);
    // The parts of a force add up to no less than it.
    EXPECT_GE(full.strength, full.force.norm() * (1.0 - 1e-12));
    EXPECT_GT(full.force.norm(), 0.4 * full.strength);
    for (const double most : {0.0, 2.0 * full.strength}) EXPECT_EQ(full.limited(most).force, full.force);
    EXPECT_NEAR(full.whole, full.force.norm(), 1e-9 * full.whole) << "it has yielded";
    // Every element's force counts for the stiffness, and their sum for the force.
    for (const double most : {0.25 * full.whole, 0.99 * full.whole, 1.01 * full.whole}) {
      const Wrench weaker = full.limited(most);
      EXPECT_NEAR(weaker.force.norm(), std::min(most, full.whole), 1e-9 * most);
      EXPECT_LT((weaker.force.normalized() - full.force.normalized()).norm(), 1e-12);
      EXPECT_NEAR(weaker.stiffness, std::min(most / full.strength, 1.0) * full.stiffness,
                  1e-9 * full.stiffness);
      scene.device.max_force = most;
      // A device is led to that by a way of so little stiffness.
      const Vector3d given = pressed(scene, 0.015).given;
      EXPECT_NEAR(given.norm(), weaker.force.norm(), 1e-6 * most);
    }
  }
}

TEST(ContactForce, OnASphereIsTheSameHoweverTheHandTurnsIt) {
  // Its tip stays its lowest point.
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes}) {
    const Scene scene = contact_scene_of(law, ToolShape::sphere);
    HeightField bed = starting_bed(scene.bed);
    SandSide sand(scene.tool, scene.displacement);
    sand.look(bed, Vector3d::Zero());
    const auto turned = [&](double angle) {
      const std::unique_ptr<ToolForce> force = make_contact_force(scene, bed.cell_size());
      force->turn(Eigen::AngleAxisd(angle, Vector3d(0.6, 0.0, 0.8)).toRotationMatrix());
      return force->in_tick(sand, bed, {0.0, 0.0, -0.005}, {0.0, 0.0, -0.01}, true);
    };
    EXPECT_GT(turned(0.0).force.z(), 0.1);
    EXPECT_EQ(turned(2.0).force, turned(0.0).force);
    EXPECT_EQ(turned(2.0).torque, turned(0.0).torque);
  }
}

TEST(ContactForce, IsKnownAgainWhenAToolSinksOnceMore) {
  // Drawn up a little, a sphere touches nothing that leads; its way through the sand is not forgotten.
  const Scene scene = contact_scene_of(ForceLaw::rft, ToolShape::sphere);
  HeightField bed = starting_bed(scene.bed);
  SandSide sand(scene.tool, scene.displacement);
  const std::unique_ptr<ToolForce> law = make_contact_force(scene, bed.cell_size());
  double z = 0.0;
  const auto go = [&](double to) {
    Wrench felt;
    for (const double step = std::copysign(2e-5, to - z); std::abs(to - z) > 1e-9; z += step) {
      const Vector3d tip(0.0, 0.0, z + step);
      sand.move(bed, tip, tip, {});
      felt = law->in_tick(sand, bed, tip, {0.0, 0.0, step}, true);
    }
    return felt;
  };
  const double deep = go(-0.006).force.z();
  go(-0.0057);
  EXPECT_NEAR(go(-0.006).force.z(), deep, 0.1 * deep);
}

TEST(ContactForce, StepsLittleInASteadyDrag) {
  // Each relaxation moves the sand before the tool at once; the hand does not feel it so.
  for (const ToolShape shape : {ToolShape::sphere, ToolShape::plate}) {
    Scene scene = contact_scene_of(ForceLaw::rft, shape);
    scene.preset = ModelPreset::accurate;
    apply_model_preset(scene);
    scene.tool.width = 0.04;
    scene.stroke.emplace();
    scene.stroke->file = "in memory";
    Stroke drag;
    drag.time = {0.0, 2.0};  // s
    drag.position = {{-0.05, 0.0, -0.006}, {0.05, 0.0, -0.006}};
    drag.gap_threshold = 1e9;
    Told told;
    const RunResult result = Simulation(scene, starting_bed(scene.bed), drag).run({&told});
    EXPECT_GT(result.relaxations, 20);
    for (std::size_t tick = 1000; tick + 1 < told.ticks.size(); ++tick) {
      const Vector3d& before = told.ticks[tick - 1].wrench.force;
      ASSERT_LT((told.ticks[tick].wrench.force - before).norm(), 0.02 * before.norm()) << tick;
    }
  }
}

}  // namespace
}  // namespace sandstroke
