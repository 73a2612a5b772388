#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/error.h"
#include "fit/contact_scene.h"
#include "fit/felt_ticks.h"
#include "fit/fitted_law.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

enum class Way { draws, plunges };

/// Two seconds of a hand that goes up and down in the sand, and in bends where it draws.
Stroke way_of(Way hand) {
  Stroke stroke;
  for (int k = 0; k <= 200; ++k) {
    const double t = 0.01 * k, depth = 0.006 - 0.005 * std::cos(std::numbers::pi * t * 2.0);
    stroke.time.push_back(t);
    if (hand == Way::draws)
      stroke.position.emplace_back(0.04 * std::sin(2.2 * t), 0.025 * std::sin(4.1 * t), -depth);
    else
      stroke.position.emplace_back(0.0, 0.0, -depth);
  }
  return stroke;
}

class Told : public SimulationObserver {
 public:
  void on_tick(const TickRecord& tick) override { ticks.push_back(tick); }
  std::vector<TickRecord> ticks;
};

/// The recording of a device that plays the stroke in that scene, with noise of that fraction of its rms
/// force on each component.
Stroke recorded_in(const Scene& scene, const Stroke& stroke, double noise = 0.0) {
  Simulation run(scene, starting_bed(scene.bed), stroke);
  Told told;
  run.run({&told});
  Stroke felt;
  double squares = 0.0;
  for (const TickRecord& tick : told.ticks) {
    felt.time.push_back(tick.time);
    felt.position.push_back(tick.hand.position);
    felt.force.push_back(tick.device_force);
    if (!stroke.orientation.empty()) felt.orientation.push_back(tick.hand.orientation.coeffs());
    squares += tick.device_force.squaredNorm();
  }
  if (noise == 0.0) return felt;
  std::mt19937 random(3);
  std::normal_distribution<double> error(0.0, noise * std::sqrt(squares / static_cast<double>(felt.size())));
  for (Vector3d& force : felt.force)
    for (double& component : force) component += error(random);
  return felt;
}

ForceFit fitted(const Scene& scene, const Stroke& recorded, const std::vector<std::string>& names = {}) {
  const FeltStroke felt{scene, starting_bed(scene.bed), recorded};
  const FittedLaw& law = fitted_law(scene.force.law);
  return law.fit(felt, chosen_constants(law.constants, names)).value();
}

Scene with(Scene scene, const SandStrength& sand) {
  scene.strength = sand;
  return scene;
}

TEST(FrictionAngle, IsTheOneOfTheResistanceWhateverTheDensity) {
  double before = 0.0;
  for (double angle = 0.5; angle < 90.0; angle += 0.5)
    for (const double density : {1000.0, 1560.0}) {
      const double xi = resistance({.friction_angle = angle, .density = density});
      EXPECT_NEAR(friction_angle_of(xi, density), angle, 1e-9);
      EXPECT_GT(xi / density, before) << angle;  // or there were two angles for one resistance
      if (density == 1560.0) before = xi / density;
    }
}

/// The forces computed beside a run are those of the run.
TEST(ContactFit, NothingIsLeftOfARunsOwnForceWithItsConstants) {
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes})
    for (const ToolShape shape : {ToolShape::sphere, ToolShape::plate, ToolShape::box}) {
      const Scene scene = scene_with(law, shape);
      Stroke stroke = way_of(Way::draws);
      for (std::size_t i = 0; i < stroke.size(); ++i)
        stroke.orientation.push_back(
            Eigen::Quaterniond(Eigen::AngleAxisd(0.01 * static_cast<double>(i), Vector3d::UnitZ())).coeffs());
      const FeltStroke felt{scene, starting_bed(scene.bed), recorded_in(scene, stroke)};
      const std::span<const ForceConstant> constants = fitted_law(law).constants;
      const ContactLaw known = felt_in(
          felt, {constants, scene.strength, values_in(scene.strength, constants), {true, false, false}});
      ASSERT_GT(known.ticks(), 500);
      const Eigen::Matrix3Xd left = known.forces(known.start(), DeviceLimit::applied) - known.recorded();
      EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-12 * known.recorded().cwiseAbs().maxCoeff());
    }
}

TEST(ContactFit, FindsTheSandThatMadeTheForce) {
  struct Case {
    ToolShape shape;
    SandStrength sand;
    double max_force;
    double angle_error;  // deg
  };
  for (const Case& one : {Case{ToolShape::sphere, {38.0, 1700.0, 0.25}, 0.0, 1e-3},
                          Case{ToolShape::box, {22.0, 1560.0, 0.6}, 0.0, 1e-3},
                          Case{ToolShape::plate, {34.0, 1400.0, 0.1}, 0.0, 1e-3},
                          // A limited device lags behind the sand's force by an elastic way of its own, which
                          // the fit leaves out.
                          Case{ToolShape::box, {34.0, 1560.0, 0.3}, 1.0, 0.02}}) {
    Scene scene = scene_with(ForceLaw::rft, one.shape);
    scene.device.max_force = one.max_force;
    scene.strength.density = one.sand.density;
    const Stroke felt = recorded_in(with(scene, one.sand), way_of(Way::draws));
    const ForceFit fit = fitted(scene, felt);
    ASSERT_EQ(fit.constants.size(), 2u);
    EXPECT_NEAR(fit.values[0], one.sand.friction_angle, one.angle_error) << one.sand.friction_angle;
    EXPECT_NEAR(fit.values[1], one.sand.tool_friction, 2e-3) << one.sand.friction_angle;
    SandStrength other = one.sand;
    other.friction_angle += one.angle_error;
    EXPECT_NEAR(fit.scale.value, resistance(one.sand), 1.01 * (resistance(other) - resistance(one.sand)));
    EXPECT_EQ(fit.values[2], scene.strength.yield_way);
    EXPECT_TRUE(fit.constants[0].determined());
    EXPECT_TRUE(fit.constants[1].determined());
    EXPECT_GT(fit.explained, 1.0 - 1e-5);
    EXPECT_LT(fit.explained_reversed, 0.1);
  }
}

TEST(ContactFit, ErrorsCoverTheTruth) {
  const SandStrength truth{38.0, 1560.0, 0.25, 0.002};
  for (const ToolShape shape : {ToolShape::sphere, ToolShape::plate}) {
    const Scene scene = scene_with(ForceLaw::rft, shape);
    const Stroke felt = recorded_in(with(scene, truth), way_of(Way::draws), 0.02);
    const ForceFit fit = fitted(scene, felt, {"friction_angle", "tool_friction", "yield"});
    const double true_values[] = {truth.friction_angle, truth.tool_friction, truth.yield_way};
    ASSERT_EQ(fit.constants.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const FittedConstant& one = fit.constants[i];
      EXPECT_NEAR(one.value, true_values[i], 4.0 * one.error) << one.constant.name;
      EXPECT_LT(one.error, 0.2 * one.value) << one.constant.name;
      EXPECT_TRUE(one.determined());
    }
    EXPECT_NEAR(fit.residual, 0.02 * std::sqrt(3.0) * fit.recorded_rms, 0.003 * fit.recorded_rms);
  }
}

TEST(ContactFit, ArchimedesTellsTheAngleAndWhereAskedForTheYieldWay) {
  const SandStrength truth{35.0, 1560.0, 0.4, 0.0025};
  const Scene scene = scene_with(ForceLaw::archimedes, ToolShape::sphere);
  const Stroke felt = recorded_in(with(scene, truth), way_of(Way::plunges));
  const ForceFit both = fitted(scene, felt, {"friction_angle", "yield"});
  EXPECT_NEAR(both.values[0], 35.0, 1e-3);
  EXPECT_NEAR(both.values[1], 0.0025, 1e-5);
  EXPECT_TRUE(both.constants[1].determined());
  Scene known = scene;
  known.strength.yield_way = truth.yield_way;
  const ForceFit fit = fitted(known, felt);
  ASSERT_EQ(fit.constants.size(), 1u);
  EXPECT_NEAR(fit.values[0], 35.0, 1e-6);
}

/// Straight down nothing slides along the underside of a box, and its sides do not lead.
TEST(ContactFit, APlungeOfABoxDoesNotTellItsFriction) {
  Scene truth = scene_with(ForceLaw::rft, ToolShape::box);
  truth.strength.friction_angle = 36.0;
  Stroke down = way_of(Way::plunges);
  for (std::size_t i = 0; i < down.size(); ++i) down.position[i].z() = -4e-5 * static_cast<double>(i);
  Scene scene = truth;
  scene.strength.friction_angle = 30.0;
  for (const double tool_friction : {0.2, 0.7}) {
    scene.strength.tool_friction = tool_friction;
    const ForceFit fit = fitted(scene, recorded_in(truth, down, 0.02));
    EXPECT_TRUE(fit.constants[0].determined());
    EXPECT_NEAR(fit.values[0], 36.0, 4.0 * fit.constants[0].error + 0.02);
    EXPECT_FALSE(fit.constants[1].determined());
    EXPECT_EQ(fit.constants[1].value, tool_friction);
    EXPECT_TRUE(fit.constants[1].kept);
    EXPECT_TRUE(std::isinf(fit.constants[1].error));
  }
}

/// More friction does nothing where sand nowhere slides along the tool.
TEST(ContactFit, ARoughToolTellsHardlyMoreThanThatItIsRough) {
  const SandStrength rough{34.0, 1560.0, 1e6};
  const Scene scene = scene_with(ForceLaw::rft, ToolShape::sphere);
  const ForceFit curved = fitted(scene, recorded_in(with(scene, rough), way_of(Way::draws), 0.02));
  EXPECT_TRUE(curved.values[1] > 1.5 || !curved.constants[1].determined()) << curved.values[1];
  const Scene flat = scene_with(ForceLaw::rft, ToolShape::plate);
  Stroke ahead = way_of(Way::draws);
  for (std::size_t i = 0; i < ahead.size(); ++i)
    ahead.position[i] = {-0.04 + 4e-4 * static_cast<double>(i), 0.0, -0.008};
  const ForceFit face_on = fitted(flat, recorded_in(with(flat, rough), ahead, 0.02));
  EXPECT_FALSE(face_on.constants[1].determined()) << face_on.values[1];
}

TEST(ContactFit, SeesAForceWithTheOtherSignAndRefusesNone) {
  const Scene scene = scene_with(ForceLaw::rft, ToolShape::sphere);
  Stroke felt = recorded_in(scene, way_of(Way::draws));
  for (Vector3d& force : felt.force) force = -force;
  const ForceFit fit = fitted(scene, felt);
  EXPECT_LT(fit.explained, 0.01);
  EXPECT_GE(fit.explained, -1e-9);
  EXPECT_GT(fit.explained_reversed, 0.99);
  for (Vector3d& force : felt.force) force.setZero();
  EXPECT_THROW(fitted(scene, felt), Error);
}

TEST(ContactFit, RefusesWhatItCannotDo) {
  const Scene scene = scene_with(ForceLaw::archimedes, ToolShape::sphere);
  Stroke felt = recorded_in(scene, way_of(Way::draws));
  EXPECT_THROW(fitted(scene, felt, {"tool_friction"}), Error);  // a constant of another law
  Scene limited = scene;
  limited.device.max_force = 1e-3;
  EXPECT_THROW(fitted(limited, recorded_in(limited, way_of(Way::draws))), Error);
  keep_samples(felt, 0, 90);
  EXPECT_THROW(fitted(scene, felt), Error);
}

/// The force grows by what no angle of a scene gives: the angle is told all the same.
TEST(ContactFit, AForceThatNoSandGivesHasAnAngleBeyondTheKeysRange) {
  const Scene scene = scene_with(ForceLaw::archimedes, ToolShape::sphere);
  Stroke felt = recorded_in(scene, way_of(Way::draws));
  for (Vector3d& force : felt.force) force *= 1000.0;  // millinewtons taken for newtons
  const ForceFit fit = fitted(scene, felt);
  EXPECT_GT(fit.values[0], 60.0);
  EXPECT_NEAR(fit.scale.value, 1000.0 * resistance(scene.strength), 1e-3 * fit.scale.value);
  EXPECT_NEAR(fit.explained, 1.0, 1e-9);
}

/// Every second tick is let go, again and again, where there are more than memory is taken for.
TEST(ContactLaw, KeepsAnEvenPartOfVeryManyTicks) {
  const SandStrength sand;
  ContactLaw law({archimedes_constants, sand, values_in(sand, archimedes_constants), {true, false}}, 0.0,
                 0.001);
  const int ticks = 230'000;
  for (int i = 0; i < ticks; ++i) {
    const std::vector<Wrench> felt(law.grid().sands().size(),
                                   {.strength = 1.0 * i, .given = {0.0, 0.0, 1.0 * i}});
    law.add(felt, {0.0, 0.0, 1.0 * i});
  }
  EXPECT_EQ(law.ticks(), ticks);
  const Eigen::Matrix3Xd recorded = law.recorded(), forces = law.forces(law.start(), DeviceLimit::applied);
  ASSERT_GT(recorded.cols(), 25'000);
  ASSERT_LE(recorded.cols(), 50'000);
  const double every = recorded(2, 1);
  for (Eigen::Index i = 0; i < recorded.cols(); ++i) {
    ASSERT_EQ(recorded(2, i), every * static_cast<double>(i));
    ASSERT_NEAR(forces(2, i), recorded(2, i), 1e-9 * ticks);
  }
  EXPECT_GT(recorded(2, recorded.cols() - 1), ticks - 1 - every);
}

}  // namespace
}  // namespace sandstroke
