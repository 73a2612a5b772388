#include "sim/stepped_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

Scene stepped_scene() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 80;
  scene.stroke.emplace();
  return scene;
}

/// A hand that goes in and out of the sand, perhaps lifted for a while, and turns.
Stroke stepped_stroke(double seconds, bool lifts) {
  Stroke stroke;
  for (int k = 0; k < static_cast<int>(1000.0 * seconds); ++k) {
    const double t = 1e-3 * k;
    stroke.time.push_back(t);
    stroke.position.push_back(
        {0.04 * std::cos(3.0 * t), 0.04 * std::sin(2.0 * t), -0.004 + 0.003 * std::sin(9.0 * t)});
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(t, Eigen::Vector3d::UnitZ()));
    stroke.orientation.push_back(turn.coeffs());
    if (lifts) stroke.contact.push_back(k > 500 && k < 600 ? pen_up : k == 500 ? pen_lifts : pen_down);
  }
  return stroke;
}

struct PlayedTicks : SimulationObserver {
  std::vector<TickRecord> ticks;
  void on_tick(const TickRecord& tick) override { ticks.push_back(tick); }
};

void expect_bits_of_a_run(const Scene& scene, bool lifts) {
  Simulation run(scene, starting_bed(scene.bed), stepped_stroke(1.0, lifts));
  PlayedTicks played;
  run.run({&played});
  SteppedSimulation stepped(scene, starting_bed(scene.bed));
  for (std::size_t k = 0; k < played.ticks.size(); ++k) {
    const TickRecord& asked = played.ticks[k];
    if (stepped.time() < asked.time - 1e-9) {  // an idle tick, of which nobody is told
      stepped.tick(Hand{asked.hand.position}, {.orientation = true});
      --k;
      continue;
    }
    const TickRecord& tick = stepped.tick(asked.hand, {.velocity = true, .orientation = true});
    ASSERT_EQ(tick.device_force, asked.device_force) << asked.time;
    ASSERT_EQ(tick.wrench.torque, asked.wrench.torque) << asked.time;
    ASSERT_EQ(tick.depth, asked.depth) << asked.time;
    ASSERT_EQ(tick.device_position, asked.device_position) << asked.time;
    ASSERT_EQ(tick.contact, asked.contact) << asked.time;
  }
  stepped.lift();
  stepped.relax();
  EXPECT_EQ((stepped.bed().grid() - run.bed().grid()).abs().maxCoeff(), 0.0);
}

TEST(SteppedSimulation, HasTheBitsOfARunOfTheSameHand) {
  for (const bool accurate : {false, true})
    for (const ForceLaw law : {ForceLaw::paper, ForceLaw::rft}) {
      Scene scene = stepped_scene();
      if (accurate) {
        scene.preset = ModelPreset::accurate;
        apply_model_preset(scene);
        scene.tool.shape = ToolShape::cone;
        scene.tool.height = 0.02;
      }
      scene.force.law = law;
      expect_bits_of_a_run(scene, true);
    }
}

TEST(SteppedSimulation, PushesADynamicDeviceAsARunDoes) {
  Scene scene = stepped_scene();
  scene.device.model = DeviceModel::dynamic;
  scene.device.delay = 2;
  expect_bits_of_a_run(scene, false);  // a run puts a lifted device to the hand
}

TEST(SteppedSimulation, RelaxesOnlyWhenToldWhereThatIsAsked) {
  const Scene scene = stepped_scene();
  SteppedSimulation stepped(scene, starting_bed(scene.bed), false), relaxing(scene, starting_bed(scene.bed));
  for (int k = 0; k < 200; ++k) {
    const Hand hand{Eigen::Vector3d(-0.04 + 4e-4 * k, 0.0, -0.008), Eigen::Vector3d::Zero(), true};
    stepped.tick(hand);
    relaxing.tick(hand);
  }
  EXPECT_GT(stepped.bed().highest(), 1.5 * relaxing.bed().highest());
  EXPECT_GT(stepped.relax().passes, 0);
  EXPECT_TRUE(stepped.relax().converged);
}

TEST(SteppedSimulation, TakesTheVelocityOfTheWayWithoutOne) {
  const Scene scene = stepped_scene();
  SteppedSimulation told(scene, starting_bed(scene.bed)), guesses(scene, starting_bed(scene.bed));
  for (int k = 0; k < 100; ++k) {
    Hand hand{Eigen::Vector3d(-0.02 + 2e-4 * k, 0.0, -0.004), Eigen::Vector3d(k > 0 ? 0.2 : 0.0, 0.0, 0.0),
              true};
    const Eigen::Vector3d force = told.tick(hand, {.velocity = true}).device_force;
    hand.velocity.setZero();
    EXPECT_LT((guesses.tick(hand).device_force - force).norm(), 1e-9);
  }
}

TEST(SteppedSimulation, RefusesWhatIsNoNumberAndAHandThatMustBeKnownBefore) {
  Scene scene = stepped_scene();
  SteppedSimulation stepped(scene, starting_bed(scene.bed));
  Hand hand{Eigen::Vector3d(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0), Eigen::Vector3d::Zero(),
            true};
  EXPECT_THROW(stepped.tick(hand), Error);
  scene.device.model = DeviceModel::dynamic;
  scene.device.drag = DragVelocity::implicit;
  EXPECT_THROW(SteppedSimulation(scene, starting_bed(scene.bed)), Error);
}

}  // namespace
}  // namespace sandstroke
