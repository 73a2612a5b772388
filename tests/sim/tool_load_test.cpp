#include "sim/tool_load.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "rules/force.h"
#include "sim/simulation.h"
#include "sim/stepped_simulation.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// A plate of 60 mm x 60 mm in 10 mm of sand, which carries what lies on it.
Scene scene_of_plate(ForceLaw law = ForceLaw::paper) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.3;
  scene.bed.cols = scene.bed.rows = 100;
  scene.tool.shape = ToolShape::box;
  scene.tool.size = {0.06, 0.06, 0.006};
  scene.tool.solid = true;
  scene.tool.carries = true;
  scene.displacement.deposit = Deposit::outward;
  scene.relaxation.law = RelaxationLaw::isotropic;
  scene.relaxation.method = RelaxationMethod::rkl;
  scene.force.law = law;
  scene.stroke.emplace();
  return scene;
}
Hand hand_at(const Vector3d& tip, double tilt = 0.0) {
  Hand hand{.position = tip, .down = true};
  hand.orientation = Eigen::AngleAxisd(tilt * std::numbers::pi / 180.0, Vector3d::UnitY());
  return hand;
}
constexpr double buried = -0.016, high = 0.08;  // m
/// Goes up at 0.1 m/s, out of the sand, and stays there until the hand feels all that lies on the tool.
void lift_plate(SteppedSimulation& run) {
  for (double z = buried; z < high; z += 1e-4) run.tick(hand_at({0.0, 0.0, z}), {.orientation = true});
  for (double t = 0.0; t < 40.0 * ToolLoad::settling; t += 1e-3)
    run.tick(hand_at({0.0, 0.0, high}), {.orientation = true});
}
double all_sand(const SteppedSimulation& run) {
  const LoadLedger ledger = run.load()->ledger();
  return run.bed().volume() + ledger.carried + ledger.in_air;
}

TEST(ToolLoad, TheHandBearsItsWeightAndNoMore) {
  for (const ForceLaw law : {ForceLaw::paper, ForceLaw::rft}) {
    const Scene scene = scene_of_plate(law);
    SteppedSimulation run(scene, starting_bed(scene.bed));
    lift_plate(run);
    const TickRecord& tick = run.tick(hand_at({0.0, 0.0, high}), {.orientation = true});
    EXPECT_FALSE(tick.contact);
    EXPECT_GT(tick.carried, 0.02);
    EXPECT_EQ(tick.carried, scene.strength.density * run.load()->carried().volume());
    EXPECT_NEAR(tick.load, tick.carried * gravity, 1e-12);
    EXPECT_EQ(tick.device_force, Vector3d(0.0, 0.0, -tick.load));
    // The plate is symmetric about its tip, and so is what lies on it.
    EXPECT_LT(tick.wrench.torque.norm(), 1e-3 * tick.load * 0.03);
    EXPECT_EQ(run.load()->ledger().in_air, 0.0);
  }
}

TEST(ToolLoad, SandBelowTheLevelAroundPressesAsAllSandDoes) {
  const Scene scene = scene_of_plate();
  SteppedSimulation run(scene, starting_bed(scene.bed));
  double before = 0.0, most = 0.0, risen = 0.0, heaviest = 0.0;
  for (double z = buried; z < 0.02; z += 1e-4) {
    const TickRecord& tick = run.tick(hand_at({0.0, 0.0, z}), {.orientation = true});
    most = std::max(most, tick.carried);
    EXPECT_LE(tick.load, most * gravity * (1.0 + 1e-12));
    // No step, not even where the plate leaves the sand and much of it spills at once.
    EXPECT_LT(std::abs(tick.load - before), 0.01 + most * gravity * 1e-3 / ToolLoad::settling) << z;
    before = tick.load;
    // It grows as a spring would that pulls the tool back, and the margin of passivity knows that.
    if (tick.load > heaviest) risen += 1e-4 * tick.load_stiffness;
    heaviest = std::max(heaviest, tick.load);
    EXPECT_LE(tick.load_stiffness, scene.strength.density * gravity * 0.066 * 0.066) << z;
    EXPECT_LE(tick.passivity_margin, scene.device.damping + scene.device.hand_damping -
                                         0.5 * tick.load_stiffness / scene.device.servo_rate + 1e-12);
    if (z == buried) {
      EXPECT_GT(tick.carried, 0.05);
      EXPECT_LT(tick.load, 0.05 * tick.carried * gravity);
    }
  }
  EXPECT_NEAR(risen / heaviest, 1.0, 0.35);
}

TEST(ToolLoad, TorqueIsThatOfItsCentreOfMass) {
  const Scene scene = scene_of_plate(ForceLaw::rft);
  HeightField slope(100, 100, 0.003);
  for (int row = 0; row < 100; ++row)
    for (int col = 0; col < 100; ++col) slope.set(row, col, 0.1 * slope.x_of(col));
  SteppedSimulation run(scene, slope);
  lift_plate(run);
  // Turned by a quarter about y its weight would pull along x; about the vertical it turns with the tool.
  const auto torque = [&](double yaw) {
    Hand hand = hand_at({0.0, 0.0, high});
    hand.orientation = Eigen::AngleAxisd(yaw, Vector3d::UnitZ());
    return Vector3d(run.tick(hand, {.orientation = true}).wrench.torque);
  };
  const Vector3d start = torque(0.0), turned = torque(0.5 * std::numbers::pi);
  EXPECT_NEAR(turned.x(), -start.y(), 1e-12);
  EXPECT_NEAR(turned.y(), start.x(), 1e-12);
  EXPECT_EQ(start.z(), 0.0);
  // Tilted, its weight goes with the tool: forward and down.
  const TickRecord& tilted = run.tick(hand_at({0.0, 0.0, high}, 10.0), {.orientation = true});
  const double arm = tilted.wrench.torque.y() / tilted.load, upright = start.y() / (gravity * tilted.carried);
  constexpr double middle = 0.010;  // m, of the sand above the tip, about
  EXPECT_NEAR(arm - upright, middle * std::sin(10.0 * std::numbers::pi / 180.0), 1e-3);
  EXPECT_GT(start.y(), 1e-5);  // more of it where x is positive, which draws that side down
}

TEST(ToolLoad, WhatSlidesOffFallsForAsLongAsItFalls) {
  const Scene scene = scene_of_plate();
  SteppedSimulation run(scene, starting_bed(scene.bed));
  const double volume = run.bed().volume();
  lift_plate(run);
  const double full = run.load()->carried().volume();
  EXPECT_NEAR(all_sand(run), volume, 1e-12 * full);
  double first_spill = 0.0, first_landing = 0.0;
  for (int k = 0; k < 800; ++k) {
    const double tilt = std::min(40.0, 0.1 * k), on_bed = run.bed().volume();
    run.tick(hand_at({0.0, 0.0, high}, tilt), {.orientation = true});
    const LoadLedger ledger = run.load()->ledger();
    EXPECT_NEAR(all_sand(run), volume, 1e-12 * full);
    EXPECT_NEAR(ledger.lifted + ledger.ran_on + ledger.caught - ledger.spilled, ledger.carried, 1e-12 * full);
    if (first_spill == 0.0 && ledger.in_air > 0.0) first_spill = run.time();
    if (first_landing == 0.0 && first_spill > 0.0 && run.bed().volume() > on_bed) first_landing = run.time();
  }
  EXPECT_LT(run.load()->carried().volume(), 0.01 * full);
  // Its rim is 80 mm above the sand, more or less, and the sand there a few mm high.
  EXPECT_NEAR(first_landing - first_spill, std::sqrt(2.0 * 0.08 / gravity), 0.03);
}

TEST(ToolLoad, ABowlUnderASpoutFillsAndRunsOver) {
  Scene scene = scene_of_plate();
  scene.tool.shape = ToolShape::bowl;
  scene.tool.radius = 0.03;
  scene.tool.height = 0.015;
  scene.tool.thickness = 0.006;
  SourceSettings spout;
  spout.at = {0.0, 0.0, 0.2};
  spout.rate = 0.05;  // kg/s
  spout.radius = 0.004;
  scene.sources = {spout};
  Stroke stroke;
  for (int k = 0; k < 4000; ++k) {
    stroke.time.push_back(1e-3 * k);
    stroke.position.push_back({0.0, 0.0, 0.1});
  }
  Simulation run(scene, starting_bed(scene.bed), stroke);
  const RunResult result = run.run();
  ASSERT_TRUE(result.load);
  const double poured = result.sources[0].poured / scene.strength.density;
  EXPECT_NEAR(result.load->caught, poured, 1e-12);
  // What is below its rim, and a cone on that.
  constexpr double inner = 0.024, rim = 0.03;
  const double full = std::numbers::pi * inner * inner * 0.009 +
                      std::numbers::pi * rim * rim * rim * std::tan(std::numbers::pi / 6.0) / 3.0;
  EXPECT_NEAR(result.load->carried / full, 0.9, 0.12);
  EXPECT_NEAR(result.load->spilled, poured - result.load->carried, 1e-12);
  EXPECT_LT(result.volume_drift, 1e-12);
}

TEST(ToolLoad, GoesOnFromItsStateWithTheSameBits) {
  const Scene scene = scene_of_plate(ForceLaw::rft);
  SteppedSimulation run(scene, starting_bed(scene.bed)), other(scene, starting_bed(scene.bed));
  lift_plate(run);
  for (int k = 0; k < 250; ++k) run.tick(hand_at({0.0, 0.0, high}, 0.1 * k), {.orientation = true});
  EXPECT_GT(run.load()->ledger().in_air, 0.0);
  other.set_state(run.state());
  for (int k = 250; k < 400; ++k)
    for (SteppedSimulation* one : {&run, &other})
      one->tick(hand_at({0.0002 * k, 0.0, high}, 0.1 * k), {.orientation = true});
  EXPECT_TRUE((run.bed().grid() == other.bed().grid()).all());
  EXPECT_TRUE((run.load()->carried().thickness() == other.load()->carried().thickness()).all());
}

TEST(ToolLoad, AToolThatFindsNoSandAboveItHasTheBitsOfOneThatDoesNotCarry) {
  Scene carries = scene_of_plate();
  carries.tool.size.z() = 0.05;
  Scene plain = carries;
  plain.tool.carries = false;
  Stroke stroke;
  for (int k = 0; k < 1000; ++k) {
    stroke.time.push_back(1e-3 * k);
    stroke.position.push_back({-0.05 + 1e-4 * k, 0.0, -0.003});
  }
  HeightGrid final[2];
  for (const Scene* scene : {&carries, &plain}) {
    Simulation run(*scene, starting_bed(scene->bed), stroke);
    run.run();
    final[scene == &plain] = run.bed().grid();
  }
  EXPECT_TRUE((final[0] == final[1]).all());
}

TEST(ToolLoad, ARunEndsWithAllItsSandInItsBooks) {
  Scene scene = scene_of_plate();
  Stroke stroke;
  for (int k = 0; k < 1200; ++k) {
    stroke.time.push_back(1e-3 * k);
    stroke.position.push_back({0.0, 0.0, std::min(buried + 1e-4 * k, high)});
    const Hand hand = hand_at(Vector3d::Zero(), k < 1000 ? 0.0 : 0.2 * (k - 1000));
    stroke.orientation.push_back(hand.orientation.coeffs());
  }
  Simulation run(scene, starting_bed(scene.bed), stroke);
  const RunResult result = run.run();
  ASSERT_TRUE(result.load);
  EXPECT_GT(result.load->lifted, 3e-5);
  EXPECT_GT(result.load->spilled, 1e-5);
  EXPECT_EQ(result.load->in_air, 0.0);
  EXPECT_LT(result.volume_drift, 1e-12);
  // Gravity gives back what it took: the sand's energy is the same for a load twice as heavy.
  scene.strength.density *= 2.0;
  Simulation heavy(scene, starting_bed(scene.bed), stroke);
  const RunResult with_heavy = heavy.run();
  EXPECT_NEAR(with_heavy.device.absorbed_energy, result.device.absorbed_energy, 1e-12);
}

}  // namespace
}  // namespace sandstroke
