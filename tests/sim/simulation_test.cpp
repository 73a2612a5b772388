#include "sim/simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/angle.h"
#include "core/error.h"
#include "sim/told.h"

namespace sandstroke {
namespace {

Scene small_scene() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.3;
  scene.bed.cols = scene.bed.rows = 150;
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  return scene;
}

/// A stroke through these points, one every `interval` seconds.
Stroke through(const std::vector<Eigen::Vector3d>& points, double interval) {
  Stroke stroke;
  stroke.position = points;
  stroke.gap_threshold = 1e9;
  for (std::size_t i = 0; i < points.size(); ++i) stroke.time.push_back(interval * static_cast<double>(i));
  return stroke;
}

TEST(Simulation, FindsALoopThatSwingsByItself) {
  // Down at 0.1 m/s, then at rest: late by 40 ticks it never comes to rest; on time it does.
  const auto swings_from = [](int delay) {
    Scene scene = small_scene();
    scene.force.k_f = 0.0;
    scene.device.model = DeviceModel::dynamic;
    scene.device.delay = delay;
    return Simulation(scene, starting_bed(scene.bed),
                      through({{0, 0, 0.005},
                               {0, 0, -0.015},
                               {0, 0, -0.015},
                               {0, 0, -0.015},
                               {0, 0, -0.015},
                               {0, 0, -0.015},
                               {0, 0, -0.015},
                               {0, 0, -0.015},
                               {0, 0, -0.015}},
                              0.5))
        .run()
        .device.swings_from;
  };
  EXPECT_FALSE(swings_from(0));
  EXPECT_FALSE(swings_from(5));
  EXPECT_TRUE(swings_from(60));
}

TEST(Simulation, WorkOfAConstantSpeedPlungeIsTheClosedForm) {
  Scene scene = small_scene();
  scene.relaxation.rate = 0.0;  // sand that falls back would change the level
  scene.device.max_force = 0.0;
  const double depth = 0.006, k_s = 1000.0, k_c = 0.5;
  Simulation simulation(scene, starting_bed(scene.bed), through({{0, 0, 0}, {0, 0, -depth}}, 3.0));
  Told recording;
  const RunResult result = simulation.run({&recording});
  EXPECT_GT(result.displaced_volume, 0.0);
  EXPECT_NEAR(recording.ticks.back().depth, depth, 1e-14);  // displacement leaves the level where it is
  EXPECT_NEAR(result.device.max_force, k_s * std::expm1(k_c * depth), 1e-10);
  // A force is held from the start of its tick: of a spring's work a fraction of v T / d is missing.
  const double speed = depth / 3.0, missing = speed / scene.device.servo_rate / depth;
  const double work = k_s * (std::expm1(k_c * depth) / k_c - depth);
  EXPECT_NEAR(1.0 - result.device.absorbed_energy / work, missing, 0.01 * missing);
}

TEST(Simulation, EncoderStepsDoNotTurnTheDepositOfASlowDrag) {
  // A drag at 10 mm/s read in steps of 30 um leaves the furrow that exact readings leave.
  const auto lowest = [](double resolution) {
    Scene scene = small_scene();
    scene.displacement.deposit = Deposit::ahead;
    scene.device.model = DeviceModel::dynamic;
    scene.device.max_force = 0.0;
    scene.device.resolution = resolution;
    scene.device.hand_stiffness = 1e4;
    scene.device.hand_damping = 60.0;
    Simulation simulation(scene, starting_bed(scene.bed),
                          through({{-0.02, 0, -0.006}, {0.02, 0, -0.006}}, 4.0));
    simulation.run();
    return -simulation.bed().grid().col(75).minCoeff();
  };
  const double exact = lowest(0.0);
  EXPECT_GT(exact, 0.003);
  EXPECT_NEAR(lowest(30e-6), exact, 0.1 * exact);
}

TEST(Simulation, AFastDragLeavesTheFurrowOfAFinerServoRate) {
  // 20 m/s: two tool radii a tick.
  const auto furrow_depth = [](bool accurate, double servo_rate, RunResult& result) {
    Scene scene = small_scene();
    scene.device.servo_rate = servo_rate;
    if (accurate) {
      scene.tool.profile = ToolProfile::sphere;
      scene.displacement.deposit = Deposit::ahead;
    }
    Simulation simulation(scene, starting_bed(scene.bed),
                          through({{-0.1, 0, -0.006}, {0.1, 0, -0.006}}, 0.01));
    result = simulation.run();
    return -simulation.bed().grid().middleCols(50, 50).colwise().minCoeff().mean();
  };
  for (const bool accurate : {false, true}) {
    RunResult coarse, fine;
    const double depth = furrow_depth(accurate, 20'000.0, fine);
    EXPECT_GT(depth, 0.003);
    EXPECT_NEAR(furrow_depth(accurate, 1000.0, coarse), depth, 0.03 * depth);
    EXPECT_EQ(coarse.ticks, 11);
    EXPECT_LE(coarse.volume_drift, 1e-12);
    EXPECT_NEAR(coarse.displaced_volume / fine.displaced_volume, 1.0, 0.1);
  }
}

TEST(Simulation, RelaxesOnceATickAtMost) {
  for (const double rate : {1000.0, 1e6, 1e308}) {
    Scene scene = small_scene();
    scene.relaxation.rate = rate;
    Simulation simulation(scene, starting_bed(scene.bed), through({{0, 0, -0.002}, {0.01, 0, -0.002}}, 0.1));
    EXPECT_EQ(simulation.run().relaxations, 101 + 1) << rate;
  }
}

TEST(Simulation, RefusesAStrokeOfMoreTicksThanCanBePlayed) {
  const Scene scene = small_scene();
  try {
    Simulation(scene, starting_bed(scene.bed), through({{0, 0, -0.002}, {0.01, 0, -0.002}}, 1e300));
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_NE(std::string(error.what()).find("lasts 1e+300 s"), std::string::npos) << error.what();
  }
}

TEST(Simulation, ALiftedHandLeavesNoPath) {
  const Scene scene = small_scene();
  Stroke stroke = through({{-0.08, 0, -0.006}, {0.08, 0, -0.006}}, 1e-3);
  stroke.contact = {pen_lifts, pen_down};
  Simulation simulation(scene, starting_bed(scene.bed), stroke);
  const RunResult result = simulation.run();
  EXPECT_EQ(result.contact_ticks, 2);
  EXPECT_EQ(simulation.bed().grid().middleCols(60, 30).abs().maxCoeff(), 0.0);
}

TEST(Simulation, ALimitedDeviceKeepsToItsLimitAtAnyDepth) {
  Scene scene = small_scene();
  const Stroke plunge = through({{0, 0, 0}, {0, 0, -1e3}}, 0.01);
  Told recording;
  Simulation simulation(scene, starting_bed(scene.bed), plunge);
  const RunResult result = simulation.run({&recording});
  EXPECT_NEAR(result.device.max_force, scene.device.max_force, 1e-12);
  EXPECT_TRUE(std::isfinite(result.device.absorbed_energy));
  EXPECT_LE(result.volume_drift, 1e-12);
  EXPECT_TRUE(std::isfinite(result.device.least_passivity_margin));
  for (const TickRecord& tick : recording.ticks) EXPECT_TRUE(tick.device_force.allFinite());
}

TEST(Simulation, WhatIsTooLargeForANumberEndsInASentence) {
  const Stroke plunge = through({{0, 0, 0}, {0, 0, -1e4}}, 0.01);  // exp(k_c d) overflows
  const auto refusal = [&](const Scene& scene) {
    try {
      Simulation(scene, starting_bed(scene.bed), plunge).run();
      return std::string("went unnoticed");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::unstable);
      return std::string(error.what());
    }
  };
  Scene scene = small_scene();
  const std::string limited = refusal(scene);  // also behind a device's limit
  EXPECT_NE(limited.find("force is too large for a number; lower force.k_s, force.k_c, force.k_f or the"),
            std::string::npos)
      << limited;
  scene.device.max_force = 0.0;
  EXPECT_NE(refusal(scene).find("force is too large for a number"), std::string::npos);
  scene.force.k_s = 1e-300;
  scene.force.k_c = 1e305;
  const std::string stiff = refusal(scene);
  EXPECT_NE(stiff.find("is too large for a number; lower force.k_s, force.k_c"), std::string::npos) << stiff;
}

TEST(Simulation, TicksAtTheServoRateAndRelaxesAtItsOwn) {
  Scene scene = small_scene();
  scene.output.frames = 10.0;
  Simulation simulation(scene, starting_bed(scene.bed), through({{0, 0, -0.002}, {0.05, 0, -0.002}}, 1.0));
  Told recording;
  const RunResult result = simulation.run({&recording});
  EXPECT_EQ(result.ticks, 1001);
  EXPECT_EQ(recording.ticks.size(), 1001u);
  EXPECT_DOUBLE_EQ(recording.ticks[250].time, 0.25);
  EXPECT_NEAR(recording.ticks[250].hand.position.x(), 0.0125, 1e-15);
  EXPECT_EQ(result.relaxations, 61);  // 60 in a second, and the one at the end
  EXPECT_EQ(recording.frames.size(), 11u);
  EXPECT_TRUE(result.relaxation.converged);
  EXPECT_LE(result.relaxation.residual, 1e-3 * (1 + 1e-9));
}

TEST(Simulation, VolumeIsConservedThroughAStrokeIntoAWall) {
  for (const ModelPreset preset : {ModelPreset::paper, ModelPreset::accurate}) {
    Scene scene = small_scene();
    if (preset == ModelPreset::accurate) {
      scene.tool.profile = ToolProfile::sphere;
      scene.displacement.deposit = Deposit::ahead;
      scene.relaxation.law = RelaxationLaw::isotropic;
    }
    Simulation simulation(scene, starting_bed(scene.bed),
                          through({{-0.1, 0, 0.01}, {0, 0.02, -0.01}, {0.15, 0.15, -0.01}}, 1.0));
    Told recording;
    const RunResult result = simulation.run({&recording});
    EXPECT_GT(result.displaced_volume, 0.0);
    EXPECT_LE(result.volume_drift, 1e-12);
  }
}

TEST(Simulation, NothingHappensInTheAirNorWhileTheToolIsLifted) {
  Scene scene = small_scene();
  Stroke stroke = through({{0, 0, 0.01}, {0.05, 0, 0.01}, {0.05, 0, -0.01}, {0, 0, -0.01}}, 0.5);
  stroke.gap_threshold = 0.4;  // every step is a gap
  Simulation lifted(scene, starting_bed(scene.bed), stroke);
  Told recording;
  const RunResult result = lifted.run({&recording});
  EXPECT_EQ(result.stroke.gaps, 3);
  // The sample at which a piece begins and ends is a touch; in between the tool is lifted.
  for (const TickRecord& tick : recording.ticks) {
    const double phase = std::fmod(tick.time, 0.5);
    if (phase > 1e-3 && phase < 0.499) {
      EXPECT_FALSE(tick.contact);
    }
  }

  Simulation above(scene, starting_bed(scene.bed), through({{0, 0, 0.01}, {0.05, 0, 0.001}}, 0.5));
  Told in_air;
  EXPECT_EQ(above.run({&in_air}).contact_ticks, 0);
  EXPECT_TRUE((above.bed().grid() == 0.0).all());
  for (const TickRecord& tick : in_air.ticks) EXPECT_EQ(tick.device_force.norm(), 0.0);
}

TEST(Simulation, DragOpposesTheMotionWithTheModelsForce) {
  Scene scene = small_scene();
  Simulation simulation(scene, starting_bed(scene.bed),
                        through({{-0.05, 0, -0.002}, {0.05, 0, -0.002}}, 1.0));
  Told recording;
  simulation.run({&recording});
  for (const TickRecord& tick : recording.ticks) {
    ASSERT_TRUE(tick.contact);
    EXPECT_NEAR(tick.repulse_force.z(), 1000.0 * std::expm1(0.5 * tick.depth), 1e-12);
    EXPECT_NEAR(tick.drag_force.x(), -10.0 * 0.1 * tick.repulse_force.z(), 1e-12);
    EXPECT_EQ(tick.drag_force.z(), 0.0);
  }
}

TEST(Simulation, ScaleMapsDeviceMetresToBedMetres) {
  Scene plain = small_scene(), scaled = small_scene();
  scaled.device.scale = 4.0;
  scaled.device.offset = {0.02, 0.0, 0.004};
  Simulation a(plain, starting_bed(plain.bed), through({{-0.05, 0, -0.002}, {0.05, 0, -0.002}}, 1.0));
  Simulation b(scaled, starting_bed(scaled.bed), through({{-0.0175, 0, -0.0015}, {0.0075, 0, -0.0015}}, 1.0));
  Told ra, rb;
  a.run({&ra});
  b.run({&rb});
  EXPECT_LT((a.bed().grid() - b.bed().grid()).abs().maxCoeff(), 1e-9);
  EXPECT_NEAR(ra.ticks[500].drag_force.x(), rb.ticks[500].drag_force.x(), 1e-9);
}

TEST(Simulation, DynamicDeviceLagsBehindAndIsPushedBack) {
  Scene scene = small_scene();
  scene.device.model = DeviceModel::dynamic;
  Simulation simulation(scene, starting_bed(scene.bed),
                        through({{-0.05, 0, 0.005}, {-0.05, 0, -0.008}, {0.05, 0, -0.008}}, 1.0));
  Told recording;
  const RunResult result = simulation.run({&recording});
  const TickRecord& last = recording.ticks.back();
  EXPECT_LT(last.device_position.x(), last.hand.position.x() - 1e-4);
  EXPECT_GT(last.device_position.z(), last.hand.position.z() + 1e-3);
  EXPECT_GT(result.device.absorbed_energy, 0.0);
  EXPECT_GE(result.device.least_absorbed_energy, -1e-6);
}

TEST(Simulation, TheForceThatActsIsTheOneComputedTicksBefore) {
  Scene scene = small_scene();
  scene.device.model = DeviceModel::dynamic;
  scene.device.delay = 7;
  scene.device.dropped_ticks = 0.3;
  Simulation simulation(scene, starting_bed(scene.bed),
                        through({{-0.02, 0, 0.002}, {-0.02, 0, -0.008}}, 0.5));
  Told recording;
  const RunResult result = simulation.run({&recording});
  ASSERT_GT(result.contact_ticks, 100);
  // The force that acts moves the device: along z the exact map of each tick gives the next position.
  const Eigen::Matrix<double, 2, 5> map = device_tick_map(scene.device);
  LateForce late(scene.device);
  double absorbed = 0.0;
  Eigen::Vector2d state(recording.ticks[0].device_position.z(), -0.02);
  for (std::size_t k = 0; k + 1 < recording.ticks.size(); ++k) {
    const TickRecord& tick = recording.ticks[k];
    const Eigen::Vector3d computed = tick.repulse_force + tick.drag_force;
    EXPECT_EQ(tick.device_force, late.act(computed)) << k;
    EXPECT_EQ(tick.dropped, drops_tick(static_cast<std::int64_t>(k), 0.3)) << k;
    Eigen::Matrix<double, 5, 1> before;
    const double hand = tick.hand.position.z(), next = recording.ticks[k + 1].hand.position.z();
    before << state, hand, (next - hand) * scene.device.servo_rate, tick.device_force.z();
    const Eigen::Vector2d after = map * before;
    absorbed -= tick.device_force.z() * (after[0] - state[0]);
    state = after;
    EXPECT_NEAR(recording.ticks[k + 1].device_position.z(), state[0], scene.device.resolution) << k;
  }
  EXPECT_NEAR(result.device.absorbed_energy, absorbed, 0.01 * absorbed);  // the last tick is not in the sum
}

TEST(Simulation, ImplicitDragIsStableWhereSampledDragThrowsTheDevice) {
  // B = k_f F_r = 10 s/m x 60 N is above 2 m / T = 500 N s/m.
  Scene scene = small_scene();
  scene.device = ideal_device();
  scene.force.k_s = 20'000.0;
  const auto run = [&](DragVelocity drag) {
    scene.device.drag = drag;
    Simulation simulation(scene, starting_bed(scene.bed),
                          through({{-0.05, 0, 0.0}, {-0.05, 0, -0.16}, {0.05, 0, -0.16}}, 0.5));
    Told recording;
    return simulation.run({&recording});
  };
  EXPECT_THROW(run(DragVelocity::sampled), Error);
  const RunResult stable = run(DragVelocity::implicit);
  EXPECT_GT(stable.device.max_force, 50.0);
  EXPECT_GT(stable.device.absorbed_energy, 0.0);
}

TEST(Simulation, ASceneWithoutAStrokeIsACollapse) {
  Scene scene = small_scene();
  scene.stroke.reset();
  scene.bed.surface.kind = SurfaceKind::cylinder;
  scene.bed.surface.radius = 0.05;
  scene.bed.surface.height = 0.05;
  Simulation simulation(scene, starting_bed(scene.bed), std::nullopt);
  Told recording;
  const RunResult result = simulation.run({&recording});
  EXPECT_EQ(result.ticks, 0);
  EXPECT_GT(result.relaxation.passes, 0);
  EXPECT_TRUE(result.relaxation.converged);
}

TEST(Simulation, RefusesAStrokeThatEntersTheSandOutsideTheBed) {
  Scene scene = small_scene();
  EXPECT_NO_THROW(Simulation(scene, starting_bed(scene.bed),
                             through({{-1, 0, 0.1}, {0, 0, -0.01}}, 1.0)));  // outside in the air
  try {
    Simulation(scene, starting_bed(scene.bed), through({{0, 0, 0.01}, {0.2, 0, -0.01}}, 1.0));
    FAIL();
  } catch (const Error& failure) {
    EXPECT_NE(std::string(failure.what()).find("outside the bed"), std::string::npos);
    EXPECT_NE(std::string(failure.what()).find("1.000 s"), std::string::npos);
  }
}

TEST(Simulation, TheBedEndsAtItsBordersForAStrokeInTheSand) {
  Scene scene = small_scene();
  scene.bed.width = 0.4;
  scene.bed.cols = 200;  // 0.4 m x 0.3 m
  scene.device.offset = {0.0, 0.0, 0.005};
  const auto is_taken = [&](const Eigen::Vector3d& tip, PenState pen = pen_down) {
    Stroke stroke = through({{0, 0, 0.01}, tip - scene.device.offset}, 1.0);
    stroke.contact = {pen_down, pen};
    try {
      Simulation(scene, starting_bed(scene.bed), stroke);
      return true;
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::input);
      return false;
    }
  };
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(is_taken({0.19 * sign, 0.0, -0.001}));
    EXPECT_FALSE(is_taken({0.21 * sign, 0.0, -0.001}));
    EXPECT_TRUE(is_taken({0.0, 0.1425 * sign, -0.001}));
    EXPECT_FALSE(is_taken({0.0, 0.1575 * sign, -0.001}));
    EXPECT_TRUE(is_taken({0.0, 0.1575 * sign, 0.001})) << "above all sand";
    EXPECT_TRUE(is_taken({0.0, 0.1575 * sign, -0.001}, pen_up));
  }
}

TEST(Simulation, PlaysUpTo1e15Ticks) {
  Scene scene = small_scene();
  scene.device.servo_rate = 2000.0;
  const auto make = [&](double seconds) {
    Simulation(scene, starting_bed(scene.bed), through({{0, 0, 0.1}, {0.01, 0, 0.1}}, seconds));
  };
  EXPECT_NO_THROW(make(0.475e12));
  EXPECT_THROW(make(0.525e12), Error);
}

TEST(Simulation, ADeviceIsLostFurtherAwayThanAHundredBeds) {
  // Nothing holds it: it goes on as fast as the hand threw it. The hand rests 2 m above the bed.
  Scene scene = small_scene();
  scene.bed.width = 0.4;
  scene.bed.cols = 200;
  scene.device.model = DeviceModel::dynamic;
  scene.device.hand_stiffness = scene.device.hand_damping = scene.device.damping = 0.0;
  Stroke thrown = through({{0, 0, 1}, {0, 0, 2}, {0, 0, 2}}, 0.0);
  thrown.time = {0.0, 0.01, 2.0};
  Told recording;
  Simulation simulation(scene, starting_bed(scene.bed), thrown);
  try {
    simulation.run({&recording});
    FAIL() << "never lost";
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::unstable);
    EXPECT_NE(std::string(failure.what()).find("diverged"), std::string::npos) << failure.what();
  }
  const double speed = recording.ticks.front().hand.velocity.z(), far = 100.0 * (0.4 + 0.3) + 2.0 * 2.0;
  ASSERT_GT(speed, 50.0);
  const double lost_at = (far - 1.0) / speed;  // s
  EXPECT_NEAR(recording.ticks.back().time, lost_at - 1.5e-3, 0.5e-3) << "the tick before that, at its start";
}

TEST(Simulation, EndsWithTheToolGoneAndTheSandAtRestWithoutIt) {
  Scene scene = small_scene();
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  Simulation simulation(scene, starting_bed(scene.bed),
                        through({{-0.02, 0, -0.008}, {0.02, 0, -0.008}}, 0.2));
  const RunResult result = simulation.run();
  EXPECT_GT(result.contact_ticks, 0);
  EXPECT_TRUE(simulation.bed().tool_walls().empty());
  HeightField alone(simulation.bed().grid(), simulation.bed().cell_size());
  const RelaxationOutcome more = make_relaxer(scene.relaxation, alone.cell_size())->relax(alone);
  EXPECT_LE(more.moved_volume, 1e-3 * result.moved_volume);
}

/// A blade that is drawn through sand, turned by itself and by its hand [deg].
struct Drawn {
  RunResult result;
  HeightGrid surface;
  std::vector<TickRecord> ticks;
};
Drawn drawn_blade(double own_turn, const std::vector<double>& hand_turns) {
  Scene scene = small_scene();
  scene.tool.shape = ToolShape::plate;
  scene.tool.solid = true;
  scene.tool.width = 0.04;
  scene.tool.orientation.z() = own_turn;
  scene.displacement.deposit = Deposit::outward;
  scene.force.law = ForceLaw::rft;
  Stroke stroke = through({{-0.05, 0.0, -0.005}, {0.0, 0.01, -0.005}, {0.05, 0.0, -0.005}}, 0.2);
  for (const double turn : hand_turns)
    stroke.orientation.push_back(
        Eigen::Quaterniond(Eigen::AngleAxisd(to_radians(turn), Eigen::Vector3d::UnitZ())).coeffs());
  Simulation simulation(scene, starting_bed(scene.bed), std::move(stroke));
  Told told;
  Drawn drawn{simulation.run({&told}), simulation.bed().grid(), {}};
  drawn.ticks = std::move(told.ticks);
  return drawn;
}

TEST(Simulation, ATurnedHandHoldsTheToolAsOneThatIsTurnedByItself) {
  const Drawn by_hand = drawn_blade(0.0, {30.0, 30.0, 30.0}), by_itself = drawn_blade(30.0, {}),
              in_part = drawn_blade(10.0, {20.0, 20.0, 20.0}), level = drawn_blade(0.0, {});
  const double furrow = -level.surface.minCoeff();
  EXPECT_LT((by_hand.surface - by_itself.surface).abs().maxCoeff(), 1e-9 * furrow);
  EXPECT_LT((in_part.surface - by_itself.surface).abs().maxCoeff(), 1e-9 * furrow);
  EXPECT_GT((level.surface - by_itself.surface).abs().maxCoeff(), 0.1 * furrow);
  for (std::size_t i = 0; i < by_hand.ticks.size(); i += 20)
    EXPECT_LT((by_hand.ticks[i].wrench.torque - by_itself.ticks[i].wrench.torque).norm(),
              1e-6 * (1e-3 + by_itself.ticks[i].wrench.torque.norm()));
}

TEST(Simulation, AToolThatTurnsOnItsWayKeepsAllSandAndEndsTurned) {
  const Drawn turning = drawn_blade(0.0, {0.0, 50.0, 90.0});
  EXPECT_LT(turning.result.volume_drift, 1e-12);
  EXPECT_GT(turning.result.moved_volume, 0.0);
  for (const TickRecord& tick : turning.ticks) ASSERT_TRUE(tick.wrench.torque.allFinite()) << tick.time;
  // Across the way at first, it carves a furrow of its width; at last along it, one of its thickness.
  const Eigen::Vector3d end = turning.ticks.back().hand.orientation * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(end.y(), 1.0, 1e-4);
  const auto dug_cells = [&](int col) { return (turning.surface.col(col) < -0.0015).count(); };
  EXPECT_GT(dug_cells(58), 2 * dug_cells(92));
}

}  // namespace
}  // namespace sandstroke
