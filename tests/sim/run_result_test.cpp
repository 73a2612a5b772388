#include "sim/run_result.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "sim/simulation.h"
#include "sim/told.h"

namespace sandstroke {
namespace {

/// All that a run reports, and what follows from it.
struct ToldRun : Told {
  std::int64_t count(const std::function<bool(const TickRecord&)>& holds) const {
    return std::count_if(ticks.begin(), ticks.end(), holds);
  }
  double sum(const std::function<double(const TickRecord&)>& of) const {
    double sum = 0.0;
    for (const TickRecord& tick : ticks) sum += of(tick);
    return sum;
  }
  /// Over ticks in contact.
  double largest(const std::function<double(const TickRecord&)>& of) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const TickRecord& tick : ticks)
      if (tick.contact) most = std::max(most, of(tick));
    return most;
  }
};

bool in_contact(const TickRecord& tick) { return tick.contact; }
double force_length(const TickRecord& tick) { return std::sqrt(tick.device_force.squaredNorm()); }

/// A bed that is not square, of 0.3 m x 0.2 m.
Scene narrow_scene() {
  Scene scene;
  scene.bed.width = 0.3;
  scene.bed.depth = 0.2;
  scene.bed.cols = 150;
  scene.bed.rows = 100;
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  return scene;
}

Stroke timed(const std::vector<double>& time, const std::vector<Eigen::Vector3d>& points) {
  Stroke stroke;
  stroke.time = time;
  stroke.position = points;
  stroke.gap_threshold = 1e9;
  return stroke;
}

double plain_volume(const HeightField& bed) {
  double sum = 0.0;
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) sum += bed(row, col);
  return sum * bed.cell_size() * bed.cell_size();
}

/// A dynamic device whose late loop gives and takes energy: down into the sand, along, out, and long enough
/// in the air that no force is left.
Scene late_scene() {
  Scene scene = narrow_scene();
  scene.bed.surface.kind = SurfaceKind::ripples;
  scene.bed.surface.amplitude = 1e-3;
  scene.device.model = DeviceModel::dynamic;
  scene.device.scale = 2.0;
  scene.device.offset = {0.01, -0.02, 0.001};
  scene.device.resolution = 0.0;
  scene.device.delay = 5;
  scene.device.dropped_ticks = 0.25;
  scene.device.max_force = 2.5;
  return scene;
}
Stroke in_and_out() {
  return timed({0.0, 0.11, 0.29, 0.4, 0.7}, {{-0.02, 0.0, 0.002},
                                             {-0.02, 0.0, -0.004},
                                             {0.02, 0.01, -0.003},
                                             {0.02, 0.01, 0.01},
                                             {0.02, 0.01, 0.03}});
}

TEST(RunResult, IsWhatItsTicksAddUpTo) {
  const Scene scene = late_scene();
  Simulation simulation(scene, starting_bed(scene.bed), in_and_out());
  const double volume_before = plain_volume(simulation.bed());
  ToldRun told;
  const RunResult result = simulation.run({&told});
  const std::int64_t contact = told.count(in_contact), ticks = static_cast<std::int64_t>(told.ticks.size());
  ASSERT_GT(contact, 100);
  ASSERT_LT(contact, ticks - 100);
  const std::int64_t saturated = told.count([](const TickRecord& tick) { return tick.saturated; });
  ASSERT_GT(saturated, 10);
  ASSERT_LT(saturated, contact);
  EXPECT_EQ(result.ticks, 701);
  EXPECT_EQ(result.ticks, ticks);
  EXPECT_DOUBLE_EQ(result.simulated_seconds, 0.701);
  EXPECT_EQ(result.contact_ticks, contact);
  EXPECT_EQ(result.stroke.gaps, 0);
  EXPECT_EQ(result.device.saturated_ticks, saturated);
  EXPECT_EQ(result.max_depth, told.largest([](const TickRecord& tick) { return tick.depth; }));

  // The force is late: some of it acts where the tool is out of the sand again.
  double max_force = 0.0;
  for (const TickRecord& tick : told.ticks) max_force = std::max(max_force, force_length(tick));
  EXPECT_DOUBLE_EQ(result.device.max_force, max_force);
  EXPECT_NE(told.sum(force_length), told.sum([](auto& tick) { return tick.contact * force_length(tick); }));
  EXPECT_NEAR(result.device.mean_force, told.sum([](const TickRecord& tick) {
    return tick.contact * force_length(tick);
  }) / static_cast<double>(contact),
              1e-12);
  EXPECT_DOUBLE_EQ(result.device.least_passivity_margin,
                   -told.largest([](const TickRecord& tick) { return -tick.passivity_margin; }));

  double absorbed = 0.0, least = 0.0;
  for (std::size_t k = 0; k + 1 < told.ticks.size(); ++k) {
    const TickRecord& tick = told.ticks[k];
    absorbed -= tick.device_force.dot(told.ticks[k + 1].device_position - tick.device_position);
    least = std::min(least, absorbed);
  }
  ASSERT_EQ(force_length(told.ticks.back()), 0.0);  // whose motion no tick tells
  ASSERT_LT(least, 0.0);
  EXPECT_NEAR(result.device.absorbed_energy, absorbed, 1e-12);
  EXPECT_NEAR(result.device.least_absorbed_energy, least, 1e-12);

  double relaxed = 0.0;
  for (const RelaxationRecord& one : told.relaxations) relaxed += one.outcome.moved_volume;
  const double displaced = told.sum([](const TickRecord& tick) { return tick.displaced_volume; });
  ASSERT_GT(displaced, 0.0);
  ASSERT_GT(relaxed, 0.0);
  EXPECT_NEAR(result.displaced_volume, displaced, 1e-12 * displaced);
  EXPECT_NEAR(result.relaxation.moved_volume, relaxed, 1e-12 * relaxed);
  EXPECT_NEAR(result.moved_volume, displaced + relaxed, 1e-12 * relaxed);
  EXPECT_NEAR(result.volume_initial, volume_before, 1e-15);
  EXPECT_NEAR(result.volume_final, plain_volume(simulation.bed()), 1e-15);
  EXPECT_EQ(result.volume_drift, std::abs(result.volume_final - result.volume_initial) / result.moved_volume);
  EXPECT_GT(result.wall_seconds, 0.0);
  EXPECT_FALSE(result.interrupted);
}

TEST(RunResult, TheMarginOfEachTickIsTheTheoremsAndTheLeastOneThatOfContact) {
  const Scene scene = late_scene();
  const DeviceSettings& d = scene.device;
  Simulation simulation(scene, starting_bed(scene.bed), in_and_out());
  ToldRun told;
  simulation.run({&told});
  const double dampers = d.damping + d.hand_damping;
  for (const TickRecord& tick : told.ticks) {
    const double stiffness = 2.0 * 1000.0 * 0.5 * std::exp(0.5 * tick.depth);
    const double drag = 2.0 * 10.0 * 1000.0 * std::expm1(0.5 * tick.depth);
    // Above the sand neither spring nor drag is felt.
    EXPECT_NEAR(tick.passivity_margin, tick.contact ? dampers - (5.5e-3 * stiffness + drag) : dampers, 1e-9)
        << tick.time;
  }

  Scene above = scene;
  above.device.offset.z() = 1.0;
  const RunResult untouched = Simulation(above, starting_bed(above.bed), in_and_out()).run();
  EXPECT_EQ(untouched.contact_ticks, 0);
  EXPECT_EQ(untouched.device.least_passivity_margin, dampers);
  EXPECT_EQ(untouched.device.mean_force, 0.0);
  EXPECT_EQ(untouched.max_depth, 0.0);
  EXPECT_EQ(untouched.volume_drift, 0.0);
}

/// Tells what a test wrote down for it, and moves nothing. All numbers of all calls differ.
class TellingRelaxer : public Relaxer {
 public:
  explicit TellingRelaxer(std::vector<bool> converged) : converged_(std::move(converged)) {}
  static RelaxationOutcome outcome(std::int64_t call, bool converged) {
    return {.passes = 100 + call,
            .super_steps = 200 + call,
            .rejected_stages = 300 + call,
            .residual = 0.001 * static_cast<double>(400 - call),
            .moved_volume = 1e-6 * static_cast<double>(500 + call),
            .cells_visited = 600 + call,
            .tiles_active_max = static_cast<int>(700 - call),
            .wake_ups = 800 + call,
            .converged = converged};
  }
  RelaxationOutcome relax(HeightField&, const PassWatcher&) override {
    const std::int64_t call = calls_++;
    return outcome(call, converged_.at(static_cast<std::size_t>(call)));
  }

 private:
  std::vector<bool> converged_;
  std::int64_t calls_ = 0;
};

TEST(RunResult, CountsAndVolumesAreOfAllRelaxationsAndTheRestIsTheLastOnes) {
  for (const bool last : {true, false}) {
    Scene scene = narrow_scene();
    scene.relaxation.rate = 30.0;
    // Three in 0.1 s, and the one at the end.
    Simulation simulation(scene, starting_bed(scene.bed),
                          timed({0.0, 0.1}, {{0.0, 0.0, 0.01}, {0.01, 0.0, 0.01}}),
                          std::make_unique<TellingRelaxer>(std::vector<bool>{true, !last, !last, last}));
    ToldRun told;
    const RunResult result = simulation.run({&told});
    ASSERT_EQ(told.relaxations.size(), 4u);
    EXPECT_EQ(result.relaxations, 4);
    EXPECT_EQ(result.relaxation.passes, 400 + 6);
    EXPECT_EQ(result.relaxation.super_steps, 800 + 6);
    EXPECT_EQ(result.relaxation.rejected_stages, 1200 + 6);
    EXPECT_EQ(result.relaxation.cells_visited, 2400 + 6);
    EXPECT_EQ(result.relaxation.wake_ups, 3200 + 6);
    EXPECT_EQ(result.relaxation.tiles_active_max, 700);
    EXPECT_NEAR(result.relaxation.moved_volume, 2006e-6, 1e-15);
    EXPECT_NEAR(result.moved_volume, 2006e-6, 1e-15);
    EXPECT_EQ(result.relaxation.residual, 0.001 * 397.0);
    EXPECT_EQ(result.relaxation.converged, last);
    for (std::int64_t i = 0; i < 4; ++i) {
      const RelaxationRecord& record = told.relaxations[static_cast<std::size_t>(i)];
      EXPECT_EQ(record.outcome.passes, 100 + i);
      EXPECT_EQ(record.outcome.residual, 0.001 * static_cast<double>(400 - i));
    }
  }
}

TEST(RunResult, ARelaxationIsToldWithItsTime) {
  // Due at the last tick before each multiple of its period; the last one after the last tick.
  Scene scene = narrow_scene();
  scene.relaxation.rate = 30.0;
  scene.output.frames = 40.0;
  Simulation simulation(scene, starting_bed(scene.bed),
                        timed({0.0, 0.1}, {{0.0, 0.0, -0.002}, {0.01, 0.0, -0.002}}));
  ToldRun told;
  const RunResult result = simulation.run({&told});
  std::vector<double> times;
  for (const RelaxationRecord& record : told.relaxations) times.push_back(record.time);
  EXPECT_EQ(times, (std::vector<double>{0.033, 0.066, 0.099, 0.101}));
  EXPECT_EQ(told.frames, (std::vector<double>{0.0, 0.025, 0.05, 0.075, 0.1}));
  EXPECT_DOUBLE_EQ(result.simulated_seconds, 0.101);
}

TEST(RunResult, AWholeNumberOfTicksIsThePeriodOfARelaxationInDoublesToo) {
  for (const int period : {19, 20, 38}) {  // 19 x (1000 / 19) is below 1000
    Scene scene = narrow_scene();
    scene.relaxation.rate = 1000.0 / period;
    Simulation simulation(scene, starting_bed(scene.bed), timed({0.0, 1.0}, {{0, 0, 0.01}, {0.1, 0, 0.01}}),
                          std::make_unique<TellingRelaxer>(std::vector<bool>(100, true)));
    ToldRun told;
    simulation.run({&told});
    ASSERT_EQ(told.relaxations.size(), static_cast<std::size_t>(1000 / period + 1));
    for (std::size_t i = 0; i + 1 < told.relaxations.size(); ++i)
      EXPECT_EQ(told.relaxations[i].time, (static_cast<double>((i + 1) * period) - 1.0) / 1000.0) << period;
  }
}

TEST(RunResult, AStrokesLastTickIsAtItsEndWhereThatIsAWholeNumberOfTicks) {
  // 1.001 x 1000 is below 1001 in doubles, and 0.29 x 1000 below 290.
  for (const double begin : {0.0, 0.003, 12.7})
    for (const auto& [duration, ticks] :
         {std::pair{1.001, 1002}, {0.29, 291}, {0.57, 571}, {0.005, 6}, {0.0104, 11}, {0.0106, 11}}) {
      Scene scene = narrow_scene();
      const Eigen::Vector3d from(-0.05, 0.01, -0.002), to(0.05, -0.02, -0.004);
      Simulation simulation(scene, starting_bed(scene.bed), timed({begin, begin + duration}, {from, to}),
                            std::make_unique<TellingRelaxer>(std::vector<bool>(100, true)));
      ToldRun told;
      simulation.run({&told});
      ASSERT_EQ(told.ticks.size(), static_cast<std::size_t>(ticks)) << begin << " + " << duration;
      for (std::size_t k = 0; k < told.ticks.size(); ++k)
        EXPECT_EQ(told.ticks[k].time, static_cast<double>(k) / 1000.0);
      const TickRecord& last = told.ticks.back();
      const double fraction = last.time / duration;  // the part of the way
      EXPECT_NEAR((last.hand.position - (from + fraction * (to - from))).norm(), 0.0, 1e-12);
      EXPECT_NEAR((last.next.position - to).norm(), 0.0, 1e-12) << "no tick goes beyond the stroke";
      EXPECT_TRUE(last.contact);
    }
}

TEST(RunResult, GapsAreCountedAndTheToolIsLiftedInThem) {
  const Scene scene = narrow_scene();
  const double down = -0.002;
  Stroke stroke = timed({0.0, 0.05, 0.2, 0.25, 0.3, 0.45, 0.5}, {{-0.05, 0, down},
                                                                 {-0.04, 0, down},
                                                                 {-0.02, 0, down},
                                                                 {0.0, 0, down},
                                                                 {0.01, 0, down},
                                                                 {0.02, 0, down},
                                                                 {0.03, 0, down}});
  stroke.gap_threshold = 0.1;
  ToldRun told;
  const RunResult result = Simulation(scene, starting_bed(scene.bed), stroke).run({&told});
  EXPECT_EQ(result.stroke.gaps, 2);
  EXPECT_EQ(result.contact_ticks, 51 + 101 + 51);
  for (const TickRecord& tick : told.ticks) {
    const bool lifted = (tick.time > 0.05 && tick.time < 0.2) || (tick.time > 0.3 && tick.time < 0.45);
    EXPECT_EQ(tick.contact, !lifted) << tick.time;
    EXPECT_EQ(std::isnan(tick.level), lifted) << tick.time;
    EXPECT_EQ(tick.hand.down, !lifted) << tick.time;
  }
}

/// Down into the sand until 0.2 s, a gap of 0.2 s, below the sand again until 0.78 s, and out of it.
Stroke with_gap_below(double down) {
  Stroke stroke = timed({0.0, 0.1, 0.2, 0.4, 0.59, 0.78, 0.95}, {{-0.05, 0, 0.002},
                                                                 {-0.05, 0, down},
                                                                 {-0.04, 0, down},
                                                                 {0.0, 0, down},
                                                                 {0.0, 0, down},
                                                                 {0.0, 0, down},
                                                                 {0.0, 0, 0.01}});
  stroke.gap_threshold = 0.195;
  return stroke;
}

TEST(RunResult, BelowTheSandAfterAGapTheForceFadesInAndNoEnergyIsOwed) {
  Scene scene = narrow_scene();
  scene.relaxation.rate = 0.0;
  scene.force.k_f = 0.0;
  scene.device.scale = 1.0;
  for (const double max_force : {0.0, 1.0}) {  // the unlimited force is 2 N
    scene.device.max_force = max_force;
    ToldRun told;
    const RunResult result = Simulation(scene, starting_bed(scene.bed), with_gap_below(-0.004)).run({&told});
    for (const TickRecord& tick : told.ticks) {
      const double after = tick.time - 0.4;
      if (tick.time > 0.2 && after < 0.0) {
        EXPECT_EQ(force_length(tick), 0.0) << tick.time;
      } else if (after >= 0.0 && after < 0.37) {
        const double due =
            max_force > 0.0 ? std::min(max_force, tick.repulse_force.z()) : tick.repulse_force.z();
        EXPECT_NEAR(force_length(tick), std::min(after / 0.1, 1.0) * due, 1e-9) << tick.time;
      }
    }
    // It went down once and came out once; in the gap it was taken out of the sand and put back.
    EXPECT_GE(result.device.least_absorbed_energy, -1e-9);
    const double work = plunge_work(0.004, max_force, scene.force);
    EXPECT_NEAR(result.device.absorbed_energy, work, 0.036 * work);  // v T / d down at 60 mm/s, up at 82 mm/s
  }
}

TEST(RunResult, HasADynamicDeviceAtTheHandAndNoLateForceAfterAGap) {
  Scene scene = narrow_scene();
  scene.device.model = DeviceModel::dynamic;
  scene.device.resolution = 0.0;
  for (const int delay : {0, 30}) {
    scene.device.delay = delay;
    ToldRun told;
    const RunResult result = Simulation(scene, starting_bed(scene.bed), with_gap_below(-0.004)).run({&told});
    const TickRecord* before = nullptr;
    for (const TickRecord& tick : told.ticks) {
      if (tick.time > 0.2 && tick.time <= 0.4) {
        EXPECT_EQ(force_length(tick), 0.0) << tick.time;
        EXPECT_EQ(tick.device_position, tick.hand.position) << tick.time;
      }
      if (before && tick.time > 0.21 && delay == 0) {
        EXPECT_LT((tick.device_force - before->device_force).norm(), 0.2) << tick.time;
      }
      before = &tick;
    }
    EXPECT_TRUE(delay > 0 || !returned_energy(result.device));
  }
}

TEST(RunResult, ALoopReturnedEnergyWhereMoreThanAThousandthCameBack) {
  const auto device = [](double absorbed, double least, double margin) {
    DeviceResult result;
    result.absorbed_energy = absorbed;
    result.least_absorbed_energy = least;
    result.least_passivity_margin = margin;
    return result;
  };
  for (const double absorbed : {2.0, -2.0}) {
    EXPECT_FALSE(returned_energy(device(absorbed, -1.9e-3, 1.0)));
    EXPECT_TRUE(returned_energy(device(absorbed, -2.1e-3, 1.0)));
  }
  EXPECT_FALSE(returned_energy(device(0.0, 0.0, 1.0)));
  DeviceSettings all_ticks, dropped;
  dropped.dropped_ticks = 0.01;
  const DeviceResult passive = device(2.0, -1.0, 0.01), active = device(2.0, -1.0, -0.01),
                     at_the_edge = device(2.0, -1.0, 0.0), sound = device(2.0, -1e-3, -0.01);
  EXPECT_FALSE(loop_returned_energy(passive, all_ticks));
  EXPECT_TRUE(loop_returned_energy(passive, dropped));
  EXPECT_TRUE(loop_returned_energy(active, all_ticks));
  EXPECT_TRUE(loop_returned_energy(at_the_edge, all_ticks));
  EXPECT_FALSE(loop_returned_energy(sound, dropped));
}

}  // namespace
}  // namespace sandstroke
