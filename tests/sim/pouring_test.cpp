// Sources in whole runs: their sand relaxes, and all of it is where the ledger says.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "core/error.h"
#include "sim/simulation.h"
#include "sim/stepped_simulation.h"
#include "sim/told.h"
#include "sim/two_drags.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

constexpr double pour_seconds = 6.0, poured_volume_rate = 4e-6, fall_height = 0.1;  // s, m^3/s, m

Scene cone_scene(int cells) {
  Scene scene;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.relaxation.law = RelaxationLaw::isotropic;
  scene.relaxation.talus_angle = 30.0;
  scene.bed.width = scene.bed.depth = 0.16;
  scene.bed.cols = scene.bed.rows = cells;
  SourceSettings& source = scene.sources.emplace_back();
  source.at = {0.0, 0.0, fall_height};
  source.rate = poured_volume_rate * scene.strength.density;
  source.stop = pour_seconds;
  return scene;
}

struct Cone {
  double radius, apex;  // m
  RunResult result;
};

Cone poured_cone(const Scene& scene) {
  Simulation simulation(scene, starting_bed(scene.bed), std::nullopt);
  const RunResult result = simulation.run();
  const HeightField& bed = simulation.bed();
  const double area = static_cast<double>((bed.grid() > 1e-6).count()) * bed.cell_area();
  return {std::sqrt(area / std::numbers::pi), bed.highest(), result};
}

double exact_radius() {
  return std::cbrt(3.0 * poured_volume_rate * pour_seconds /
                   (std::numbers::pi * std::tan(std::numbers::pi / 6.0)));
}

TEST(Pouring, MakesAConeOfTheTalusAngle) {
  double radius_before = 1.0, apex_before = 1.0;
  for (const int cells : {32, 64, 128}) {
    const Cone cone = poured_cone(cone_scene(cells));
    const double of_radius = cone.radius / exact_radius() - 1.0;
    const double of_apex = 1.0 - cone.apex / (exact_radius() * std::tan(std::numbers::pi / 6.0));
    RecordProperty("radius_" + std::to_string(cells), std::to_string(of_radius));
    RecordProperty("apex_" + std::to_string(cells), std::to_string(of_apex));
    EXPECT_LT(std::abs(of_radius), 0.3 * 32.0 / cells * 0.16);  // first order
    EXPECT_LT(std::abs(of_radius), 0.7 * radius_before);
    EXPECT_LT(of_apex, 0.7 * apex_before);
    radius_before = std::abs(of_radius);
    apex_before = of_apex;
    EXPECT_LT(cone.result.volume_drift, 1e-14);
    ASSERT_EQ(cone.result.sources.size(), 1U);
    EXPECT_EQ(cone.result.sources[0].in_air, 0.0);
    EXPECT_NEAR(cone.result.sources[0].landed, cone.result.sources[0].poured,
                1e-14 * cone.result.sources[0].poured);
    EXPECT_NEAR(cone.result.simulated_seconds, pour_seconds + std::sqrt(2.0 * fall_height / 9.81), 0.06);
  }
}

TEST(Pouring, DoesNotDependOnHowOftenSandRelaxes) {
  Scene often = cone_scene(64), seldom = often;
  often.relaxation.rate = 60.0;
  seldom.relaxation.rate = 15.0;
  const Cone by_way = poured_cone(cone_scene(64)), of_often = poured_cone(often),
             of_seldom = poured_cone(seldom);
  EXPECT_NEAR(of_often.radius, of_seldom.radius, 2e-3 * of_often.radius);
  EXPECT_NEAR(by_way.radius, of_often.radius, 1e-12);  // it relaxes at 60 Hz, too
  EXPECT_NEAR(static_cast<double>(by_way.result.relaxations), 60.0 * pour_seconds, 10.0);
}

/// Two drags with a pause, and a source and a sink beside them that go on after the stroke.
Scene drags_with_sources() {
  Scene scene = bed_of_two_drags();
  SourceSettings& source = scene.sources.emplace_back();
  source.at = {0.0, 0.0, 0.2};
  source.rate = 2e-3;
  source.stop = 3.0;
  SourceSettings& sink = scene.sources.emplace_back();
  sink.at = {0.02, 0.02, -0.01};
  sink.rate = -1e-3;
  sink.radius = 0.004;
  return scene;
}

TEST(Pouring, GoesOnInPausesAndAfterTheStroke) {
  const Scene scene = drags_with_sources();
  std::optional<HeightGrid> end;
  for (const Pause pause : {Pause::unsampled, Pause::sampled}) {
    Simulation simulation(scene, starting_bed(scene.bed), two_drags(1.5, pause));
    const RunResult result = simulation.run();
    EXPECT_NEAR(result.sources[0].landed, 2e-3 * 3.0, 1e-15);
    EXPECT_EQ(result.sources[0].in_air, 0.0);
    EXPECT_NEAR(result.sources[1].asked, 1e-3 * simulation.stroke_seconds(), 1e-15);  // without a stop
    EXPECT_NEAR(result.sources[1].taken, result.sources[1].asked, 1e-12);
    EXPECT_LT(result.volume_drift, 1e-13);
    EXPECT_NEAR(simulation.seconds(), 3.0, 1e-12);
    EXPECT_NEAR(result.simulated_seconds, 3.0 + std::sqrt(0.4 / 9.81), 0.01);
    if (end) {
      EXPECT_EQ((simulation.bed().grid() - *end).abs().maxCoeff(), 0.0);
    }
    end = simulation.bed().grid();
  }
}

TEST(Pouring, KeepsFramesAndRelaxesWithoutAStroke) {
  Scene scene = cone_scene(32);
  scene.sources[0].stop = 0.5;
  scene.output.frames = 10.0;
  Simulation simulation(scene, starting_bed(scene.bed), std::nullopt);
  Told told;
  const RunResult result = simulation.run({&told});
  ASSERT_EQ(told.frames.size(), 7U);  // until it has landed, at 0.64 s
  EXPECT_NEAR(told.frames.back(), 0.6, 1e-9);
  EXPECT_TRUE(told.ticks.empty());
  EXPECT_EQ(static_cast<std::int64_t>(told.relaxations.size()), result.relaxations);
}

TEST(Pouring, GoesOnFromAStateWithTheSameBits) {
  for (const bool with_stroke : {true, false}) {
    const Scene scene = with_stroke ? drags_with_sources() : cone_scene(32);
    const std::optional<Stroke> stroke =
        with_stroke ? std::optional(two_drags(1.5, Pause::unsampled)) : std::nullopt;
    for (const std::int64_t at : {100, 2600}) {  // the second: after the stroke
      std::int64_t asked = 0;
      std::string state;
      Checkpoints keeps;
      keeps.due = [&] { return ++asked == at; };
      keeps.keep = [&](std::string kept) { state = std::move(kept); };
      Simulation whole(scene, starting_bed(scene.bed), stroke);
      const RunResult of_whole = whole.run({}, keeps);
      ASSERT_FALSE(state.empty());
      Simulation rest(scene, starting_bed(scene.bed), stroke);
      Checkpoints from;
      from.from = state;
      const RunResult of_rest = rest.run({}, from);
      EXPECT_EQ((whole.bed().grid() - rest.bed().grid()).abs().maxCoeff(), 0.0);
      EXPECT_EQ(of_rest.sources[0].landed, of_whole.sources[0].landed);
      EXPECT_EQ(of_rest.ticks, of_whole.ticks);
      EXPECT_EQ(of_rest.relaxations, of_whole.relaxations);
    }
  }
}

TEST(Pouring, OntoASolidToolSlidesOffIt) {
  Scene scene = cone_scene(80);
  scene.tool.radius = 0.01;
  scene.sources[0].rate = 0.01;
  SteppedSimulation stepped(scene, starting_bed(scene.bed));
  const double depth = 0.008;
  Hand hand{Eigen::Vector3d(0.0, 0.0, 0.01), Eigen::Vector3d::Zero(), true};
  for (int k = 0; k < 2000; ++k) {
    hand.position.z() = std::max(-depth, 0.01 - 1e-4 * k);
    const TickRecord& tick = stepped.tick(hand);
    if (k > 300) {
      ASSERT_TRUE(tick.contact);
    }
  }
  // Under the tool is no sand above its underside, and nothing of what landed is lost.
  const HeightField& bed = stepped.bed();
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      const double away = std::hypot(bed.x_of(col), bed.y_of(row));
      if (away < 0.9 * scene.tool.radius) {
        EXPECT_LT(bed(row, col), -depth + scene.tool.radius - std::sqrt(1e-4 - away * away) + 1e-3);
      }
    }
  const double fall = std::sqrt(2.0 * (fall_height + depth) / 9.81);  // to the sand under the tool
  EXPECT_NEAR(bed.volume() * scene.strength.density, 0.01 * (2.0 - fall), 0.01 * 2e-3);
}

TEST(Pouring, OfHostileSettingsEndsOrIsRefused) {
  const auto run = [](const std::function<void(SourceSettings&)>& change) {
    Scene scene = cone_scene(24);
    SourceSettings& source = scene.sources[0];
    source.stop = 0.05;
    change(source);
    try {
      Simulation simulation(scene, starting_bed(scene.bed), std::nullopt);
      const RunResult result = simulation.run();
      EXPECT_TRUE(simulation.bed().grid().isFinite().all());
      EXPECT_LT(result.volume_drift, 1e-12);
      const SourceLedger& ledger = result.sources[0];
      EXPECT_NEAR(ledger.landed, ledger.poured, 1e-14 * ledger.poured);
      EXPECT_EQ(ledger.in_air, 0.0);
      EXPECT_LE(ledger.taken, ledger.asked);
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::unstable);
    }
  };
  run([](SourceSettings& s) { s.rate = 1e308; });
  run([](SourceSettings& s) { s.rate = 1e-300; });
  run([](SourceSettings& s) { s.rate = -1e308; });
  run([](SourceSettings& s) { s.rate = -1e308, s.at.z() = -1e-3, s.radius = 1e300; });
  run([](SourceSettings& s) { s.at.z() = -1e300; });
  run([](SourceSettings& s) { s.at.z() = 1e3; });
  run([](SourceSettings& s) { s.at.x() = s.at.y() = 1e300; });
  run([](SourceSettings& s) { s.radius = 1e300; });
  run([](SourceSettings& s) { s.start = 0.0499999; });
  run([](SourceSettings& s) { s.start = 1.0; });  // after its stop: it never opens
}

TEST(Pouring, EndsOnlyWhereASourceStops) {
  Scene scene = cone_scene(32);
  scene.sources[0].stop = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Simulation(scene, starting_bed(scene.bed), std::nullopt), Error);
}

}  // namespace
}  // namespace sandstroke
