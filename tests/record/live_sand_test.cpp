#include "record/live_sand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "allocations.h"
#include "core/error.h"
#include "haptics/recording.h"
#include "haptics/simulated_device.h"
#include "record/felt_loop.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

Scene small_scene() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.3;
  scene.bed.cols = scene.bed.rows = 150;
  return scene;
}

/// A hand that dips in and out of the sand on a winding way: smooth, so that its acceleration is known.
struct SmoothHand {
  static constexpr double radius = 0.06, turn = 2.0 * std::numbers::pi / 2.0, dip = 0.006,
                          dive = 2.0 * std::numbers::pi / 0.7;
  static Eigen::Vector3d at(double t) {
    return {radius * std::cos(turn * t), radius * std::sin(turn * t), 0.001 + dip * std::cos(dive * t)};
  }
  static constexpr double speed() { return radius * turn + dip * dive; }
  static constexpr double acceleration() { return radius * turn * turn + dip * dive * dive; }
};

Stroke sampled(const std::vector<double>& times) {
  Stroke stroke;
  stroke.time = times;
  for (const double t : times) stroke.position.push_back(SmoothHand::at(t));
  return stroke;
}

struct Ticks : SimulationObserver {
  std::vector<TickRecord> ticks;
  void on_tick(const TickRecord& tick) override { ticks.push_back(tick); }
};

struct Feeling {
  std::vector<Eigen::Vector3d> forces;  // N, per sample
  HeightGrid bed, relaxing;
  LiveSandReport report;
};

/// Feels at these times; the sand relaxes as often as the scene says, by the loop's own time.
Feeling feel_all(const Scene& scene, const std::vector<double>& times) {
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  Feeling feeling;
  for (const double t : times) {
    feeling.forces.push_back(sand.feel(t, {SmoothHand::at(t)}).force);
    const double rate = scene.relaxation.rate, next = std::floor((t + 1e-3) * rate + 1e-9);
    if (next > std::floor(t * rate + 1e-9)) sand.relax_once();
  }
  feeling.report = sand.finish();
  feeling.bed = sand.bed().grid();
  feeling.relaxing = sand.relaxed_bed().grid();
  return feeling;
}

std::vector<double> even_times(double seconds) {
  std::vector<double> times;
  for (int k = 0; k < static_cast<int>(1000.0 * seconds); ++k)
    times.push_back(static_cast<double>(k) / 1000.0);
  return times;
}

/// A scene whose tool may be solid, too.
class LiveTool : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Solid, LiveTool, testing::Bool());

TEST_P(LiveTool, HasTheSandAndTheRepulseForceOfARunInEvenTicks) {
  Scene scene = small_scene();
  scene.tool.solid = GetParam();
  if (scene.tool.solid) {
    scene.displacement.deposit = Deposit::outward;
    // Sand that falls in where the tool was has far to go, and does so in turns of so many passes.
    scene.relaxation.max_passes = 50;
  }
  const std::vector<double> times = even_times(2.5);
  const Feeling felt = feel_all(scene, times);
  EXPECT_GT(felt.report.contact_ticks, 500);
  EXPECT_GT(felt.report.relaxation.passes, 100);
  EXPECT_EQ(felt.report.deferred_ticks, 0);

  scene.stroke.emplace();
  Simulation simulation(scene, starting_bed(scene.bed), sampled(times));
  Ticks run;
  const RunResult result = simulation.run({&run});
  ASSERT_EQ(run.ticks.size(), times.size());
  // Two beds that differ by rounding may differ about whether a cell rests: by the tolerance of its slope.
  const double tip =
      scene.relaxation.tolerance * talus_slope(scene.relaxation.talus_angle) * scene.bed.cell_size();
  const double stiffness = scene.force.k_s * scene.force.k_c * std::exp(scene.force.k_c * 0.01);
  // Drag is horizontal: what is felt upward is the repulse force.
  const double lag = 0.5e-3 * LiveSand::velocity_window + 1e-3;  // s; the second: of the run's slope
  double most = 0.0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const TickRecord& tick = run.ticks[k];
    EXPECT_NEAR(felt.forces[k].z(), tick.repulse_force.z(), stiffness * tip) << times[k];
    const double drag = scene.force.k_f * tick.repulse_force.z() * SmoothHand::acceleration() * lag;
    EXPECT_LE((felt.forces[k] - tick.device_force).norm(), drag + 2.0 * stiffness * tip) << times[k];
    most = std::max(most, felt.forces[k].norm());
  }
  EXPECT_GT(most, 2.0);
  EXPECT_LT((felt.bed - felt.relaxing).abs().maxCoeff(), 1e-12);
  // A solid tool is gone at the end of a run, and sand falls in where it stood.
  const Eigen::Vector3d last = SmoothHand::at(times.back());
  double apart = 0.0;
  for (int row = 0; row < felt.bed.rows(); ++row)
    for (int col = 0; col < felt.bed.cols(); ++col) {
      const HeightField& bed = simulation.bed();
      const bool stood =
          std::hypot(bed.x_of(col) - last.x(), bed.y_of(row) - last.y()) < 4.0 * scene.tool.radius;
      if (!GetParam() || !stood) apart = std::max(apart, std::abs(felt.bed(row, col) - bed(row, col)));
    }
  EXPECT_LT(apart,
            50.0 * tip);  // a cell that rests in one bed only keeps others from moving there: 3 % of a cell
  EXPECT_GT(result.moved_volume, 0.0);
}

/// accurate, with a law of the contact, and sand that does not relax.
Scene contact_scene(ForceLaw law, ToolShape shape) {
  Scene scene = small_scene();
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.relaxation.rate = scene.relaxation.way = 0.0;
  scene.relaxation.max_passes = 0;
  scene.force.law = law;
  scene.tool.shape = shape;
  scene.tool.height = 0.03;
  scene.device.max_force = 3.3;
  scene.strength.density *= 10.0;  // that forces are large with this hand
  return scene;
}

TEST(LiveSand, HasTheForceOfARunWithALawOfTheContact) {
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes})
    for (const ToolShape shape : {ToolShape::sphere, ToolShape::cone, ToolShape::plate}) {
      Scene scene = contact_scene(law, shape);
      const std::vector<double> times = even_times(1.0);
      const Feeling felt = feel_all(scene, times);
      scene.stroke.emplace();
      Simulation simulation(scene, starting_bed(scene.bed), sampled(times));
      Ticks run;
      simulation.run({&run});
      double most = 0.0;
      for (std::size_t k = 0; k < times.size(); ++k) {
        EXPECT_LT((felt.forces[k] - run.ticks[k].device_force).norm(), 1e-6) << times[k];
        most = std::max(most, felt.forces[k].norm());
      }
      EXPECT_GT(most, 0.05);
      EXPECT_LE(most, 3.3 * (1.0 + 1e-12));
    }
}

/// A blade that a hand presses in, turns by a right angle in a second, and holds.
Eigen::Quaterniond turning(double t) {
  const double angle = 0.5 * std::numbers::pi * std::clamp(t - 0.2, 0.0, 1.0);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}
DeviceReading turning_reading(double t) {
  DeviceReading reading;
  reading.position = {0.0, 0.0, 0.002 - 0.01 * std::min(t / 0.2, 1.0)};
  reading.orientation = turning(t);
  return reading;
}

TEST(LiveSand, TurnsTheToolWithTheHandAsARunDoes) {
  Scene scene = contact_scene(ForceLaw::rft, ToolShape::plate);
  scene.device.max_force = 0.0;
  const std::vector<double> times = even_times(1.5);
  LiveSand sand(scene, starting_bed(scene.bed), {"bed", any_force, true});
  Stroke stroke;
  stroke.time = times;
  std::vector<double> forces;
  for (const double t : times) {
    const DeviceReading reading = turning_reading(t);
    forces.push_back(sand.feel(t, reading).force.z());
    sand.shape();
    stroke.position.push_back(reading.position);
    stroke.orientation.push_back(turning(t - 1e-3).coeffs());  // what displaces is a tick behind
  }
  EXPECT_TRUE(sand.orientation().isApprox(turning(1.5), 1e-12));
  scene.stroke.emplace();
  Simulation simulation(scene, starting_bed(scene.bed), stroke);
  Ticks run;
  simulation.run({&run});
  const HeightGrid live = sand.bed().grid(), ran = simulation.bed().grid();
  EXPECT_LT((live - ran).abs().maxCoeff(), 1e-12);
  EXPECT_GT(ran.abs().sum() * 4e-6, 1e-6) << "m^3: a quarter of a disc";
  for (std::size_t k = 202; k < times.size(); ++k)  // since it turns
    EXPECT_NEAR(forces[k - 1], run.ticks[k].device_force.z(), 0.04 * forces[k - 1])
        << times[k] << ": it covers its cells a tick late";
  EXPECT_GT(forces.back(), 1.0);
  // Nothing turns with a device that does not measure how it is turned.
  LiveSand straight(scene, starting_bed(scene.bed), {"bed"});
  for (const double t : times) {
    straight.feel(t, turning_reading(t));
    straight.shape();
  }
  EXPECT_GT((straight.bed().grid() - ran).abs().sum(), 0.3 * ran.abs().sum());
}

TEST(LiveSand, TakesNoMemoryInTheLoopAndTurnsItsRelaxationWithATool) {
  Scene scene = contact_scene(ForceLaw::rft, ToolShape::plate);
  scene.relaxation.rate = 60.0;
  scene.relaxation.max_passes = RelaxationSettings{}.max_passes;
  const HeightField start = starting_bed(scene.bed);
  LiveSand sand(scene, start, {"bed", any_force, true});
  sand.start();
  const std::vector<double> times = even_times(1.5);
  const std::int64_t before = allocations_of_this_thread();
  const auto feel = [&](double t) {
    sand.feel(t, turning_reading(t));
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  };
  for (const double t : times) feel(t);
  // A thread makes the turned shapes, whenever it has its turn. The hand holds until it has displaced across
  // x.
  for (double t = times.back() + 1e-3; !(sand.bed()(75, 75 + 20) < -0.003); t += 1e-3) feel(t);
  if (allocations_are_counted()) {
    EXPECT_EQ(allocations_of_this_thread(), before);
  }
  sand.finish();
  EXPECT_LT((sand.bed().grid() - sand.relaxed_bed().grid()).abs().maxCoeff(), 1e-12);
  EXPECT_LT(std::abs(sand.bed().volume() - start.volume()), 1e-15);
}

/// m/s, how fast a device still moves, at most, that a hand has pressed into the sand, drawn back a little,
/// and holds there for two seconds, in which little but the hand's own damper takes energy; its force acts a
/// tick late.
double shaking(const Scene& scene) {
  DeviceSettings device = scene.device;
  device.model = DeviceModel::dynamic;
  device.resolution = 0.0;
  SimulatedDevice held(device, {Eigen::Vector3d(0.0, 0.0, 0.005), Eigen::Vector3d::Zero()});
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  Eigen::Vector3d acts = Eigen::Vector3d::Zero(), late = acts;
  const auto hand = [](double t) {
    const double down = std::min(t / 0.4, 1.0), back = std::clamp((t - 0.5) / 0.1, 0.0, 1.0);
    const double speed = t < 0.4 ? -0.05 : t > 0.5 && t < 0.6 ? 0.04 : 0.0;
    return SimulatedDevice::State{Eigen::Vector3d(0.0, 0.0, 0.005 - 0.02 * down + 0.004 * back),
                                  Eigen::Vector3d(0.0, 0.0, speed)};
  };
  double fastest = 0.0;
  for (const double t : even_times(3.0)) {
    acts = late;
    late = sand.feel(t, {held.state().position}).force;
    held.advance(hand(t), hand(t + 1e-3), acts);
    if (t > 2.5) fastest = std::max(fastest, held.state().velocity.norm());
  }
  return fastest;
}

TEST(LiveSand, LetsAHandRestWhereTheoryDoesWithALawOfTheContact) {
  Scene scene = contact_scene(ForceLaw::rft, ToolShape::sphere);
  DeviceSpecification touch;
  touch.max_force = 3.3;
  const FeltLoop loop = felt_loop(scene, touch, any_force, 1000.0).value();
  scene = settling_scene(loop, scene).value();
  EXPECT_LT(shaking(scene), 1e-4);
  scene.strength.yield_way /= 30.0;
  EXPECT_FALSE(felt_loop(scene, touch, any_force, 1000.0)->is_stable());
  EXPECT_GT(shaking(scene), 1e-2) << "as hard as that, and it shakes";
}

TEST(LiveSand, AToolThatRestsDeepIsDueAForceThatItDoesNotFeel) {
  // The interlock must stay closed (ForceGuard) at the beginning, and after a gap.
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes})
    for (const ToolShape shape : {ToolShape::sphere, ToolShape::plate}) {
      const Scene scene = contact_scene(law, shape);
      LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
      for (const double t : {0.0, 0.001, 0.5, 0.501}) {
        const FeltForce felt = sand.feel(t, {Eigen::Vector3d(0.0, 0.0, -0.01)});
        EXPECT_LT(felt.force.norm(), 1e-9) << t;
        EXPECT_GT(felt.due, 1.0) << t;
      }
      EXPECT_EQ(sand.feel(0.6, {Eigen::Vector3d(0.0, 0.0, 0.05)}).due, 0.0);
    }
}

TEST(LiveSand, FlagsAForceWeakenedBeyondTheScenesLimit) {
  const Scene scene = contact_scene(ForceLaw::rft, ToolShape::plate);  // of 3.3 N
  for (const double largest : {any_force, 3.3, 1.0}) {
    LiveSand sand(scene, starting_bed(scene.bed), {"bed", largest});
    std::uint32_t flags = 0;
    double most = 0.0;
    for (int k = 0; k < 100; ++k) {
      const FeltForce felt = sand.feel(1e-3 * k, {Eigen::Vector3d(0.0, 0.0, -1e-4 * k)});
      flags |= felt.flags;
      most = std::max(most, felt.force.norm());
    }
    EXPECT_EQ(flags, largest < 3.3 ? clamped_force : 0u);
    EXPECT_NEAR(most, std::min(largest, 3.3), 0.3);
  }
}

TEST(LiveSand, KeepsTheForceOfALawOfTheContactWhileDisplacementIsDeferred) {
  // The relaxing bed is far behind, and the hand rises: lift is gone after the yield way.
  Scene scene = contact_scene(ForceLaw::archimedes, ToolShape::box);
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  int k = 0;
  std::uint32_t flags = 0;
  for (; k < 200'000 && !(flags & deferred_sand); ++k) {
    const double angle = 0.05 * k;
    flags =
        sand.feel(1e-3 * k, {Eigen::Vector3d(0.1 * std::cos(angle), 0.1 * std::sin(angle), -0.01 - 1e-7 * k)})
            .flags;
  }
  ASSERT_TRUE(flags & deferred_sand);
  const double angle = 0.05 * (k - 1), z = -0.01 - 1e-7 * (k - 1);
  FeltForce felt;
  for (int i = 1; i <= 20; ++i, ++k)
    felt = sand.feel(1e-3 * k, {Eigen::Vector3d(0.1 * std::cos(angle), 0.1 * std::sin(angle), z + 1e-4 * i)});
  EXPECT_EQ(felt.force.norm(), 0.0);
}

TEST(LiveSand, AHandThatIsNotTurnedInItsFrameDoesNotTurnTheTool) {
  const Scene scene = contact_scene(ForceLaw::rft, ToolShape::plate);
  LiveSand sand(scene, starting_bed(scene.bed), {"device", any_force, true});
  DeviceReading reading;
  reading.position = {0.0, 0.0, -0.005};
  for (int k = 0; k < 3; ++k) {
    sand.feel(1e-3 * k, reading);
    sand.shape();
  }
  EXPECT_TRUE(sand.orientation().isApprox(Eigen::Quaterniond::Identity(), 1e-12));
  EXPECT_LT(sand.bed()(75 + 20, 75), -0.003) << "its width is along y";
  // Turned about the axis towards the operator, which is the bed's -y.
  reading.orientation = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  sand.feel(3e-3, reading);
  const Eigen::Quaterniond about_y(Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(sand.orientation().isApprox(about_y, 1e-12));
}

TEST(LiveSand, BesideTheBedTheLowestPointOfTheToolCounts) {
  Scene scene = contact_scene(ForceLaw::rft, ToolShape::plate);
  scene.tool.orientation = {180.0, 0.0, 0.0};  // it hangs 30 mm below its tip
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  EXPECT_FALSE(sand.feel(0.0, {Eigen::Vector3d(0.5, 0.0, 0.02)}).is_above_or_in_sand);
  EXPECT_TRUE(sand.feel(0.001, {Eigen::Vector3d(0.5, 0.0, 0.04)}).is_above_or_in_sand);
}

TEST(LiveSand, GivesANumberPastACornerOfTheBedWithALawOfTheContact) {
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes}) {
    const Scene scene = contact_scene(law, ToolShape::sphere);
    LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
    for (int k = 0; k < 800; ++k) {
      const double x = 0.1 + 1e-4 * k;
      EXPECT_TRUE(sand.feel(1e-3 * k, {Eigen::Vector3d(x, x, -0.005)}).force.allFinite()) << x;
    }
  }
}

TEST(LiveSand, BeginsALawOfTheContactAnewAfterAGap) {
  const Scene scene = contact_scene(ForceLaw::rft, ToolShape::sphere);
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  FeltForce felt;
  for (int k = 0; k < 100; ++k) felt = sand.feel(1e-3 * k, {Eigen::Vector3d(0.0, 0.0, 0.002 - 1e-4 * k)});
  EXPECT_GT(felt.force.z(), 0.5);
  const Eigen::Vector3d there(0.0, 0.0, 0.002 - 1e-4 * 99);
  EXPECT_NEAR(sand.feel(0.1, {there}).force.z(), felt.force.z(), 1e-9) << "it holds while the hand rests";
  EXPECT_EQ(sand.feel(0.3, {there}).force.norm(), 0.0) << "its way there is not known";
}

TEST(LiveSand, IsWithinTheBoundOfSamplingInUnevenTicks) {
  // Ticks up to 0.4 ms late, some missing; sand that does not relax, so that nothing but sampling differs.
  Scene scene = small_scene();
  scene.relaxation.rate = 0.0;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> late(0.0, 0.4e-3);
  std::vector<double> times = {0.0};
  for (int k = 1; k < 2500; ++k)
    if (k % 97 != 0 && k % 501 > 4) times.push_back(k * 1e-3 + late(random));
  const Feeling felt = feel_all(scene, times);

  scene.stroke.emplace();
  Simulation simulation(scene, starting_bed(scene.bed), sampled(times));
  Ticks run;
  simulation.run({&run});
  // The run's tick before or after a sample is as near as a tick; the hand has gone that far, its force
  // changed by as much, and the level under it by the tool's own furrow, which is no deeper than the hand
  // goes in that time, plus what it had not yet displaced on its way there: twice the way in all.
  const double longest = 6e-3;  // s, between samples
  const double way = SmoothHand::speed() * 1e-3, lag = 0.5 * LiveSand::velocity_window * 1e-3 + longest;
  const double stiffness = scene.force.k_s * scene.force.k_c * std::exp(scene.force.k_c * 0.01);
  double most = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto k = static_cast<std::size_t>(std::lround(times[i] * 1000.0));
    if (k >= run.ticks.size()) continue;
    const TickRecord& tick = run.ticks[k];
    const double repulse = std::max(felt.forces[i].z(), tick.repulse_force.z());
    const double bound = 2.0 * stiffness * way * (1.0 + scene.force.k_f * SmoothHand::speed()) +
                         scene.force.k_f * repulse * SmoothHand::acceleration() * lag;
    const double error = (felt.forces[i] - tick.device_force).norm();
    EXPECT_LE(error, bound) << times[i];
    worst = std::max(worst, error / bound);
    most = std::max(most, felt.forces[i].norm());
  }
  EXPECT_GT(most, 2.0);
  RecordProperty("largest_fraction_of_the_bound", std::to_string(worst));
}

TEST(LiveSand, RelaxingInItsOwnThreadLosesNoSand) {
  Scene scene = small_scene();
  scene.relaxation.rate = 1000.0;
  const HeightField start = starting_bed(scene.bed);
  LiveSand sand(scene, start, {"bed"});
  sand.start();
  int ticks = 0;
  for (const double t : even_times(2.0)) {
    sand.feel(t, {SmoothHand::at(t)});
    if (++ticks % 20 == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // its turn, most likely
  }
  sand.finish();
  EXPECT_LT((sand.bed().grid() - sand.relaxed_bed().grid()).abs().maxCoeff(), 1e-12);
  EXPECT_LT(std::abs(sand.bed().volume() - start.volume()), 1e-15);
}

/// Expects this of so many seconds, with more than so many ticks of contact.
void expect_no_memory_in_loop(const Scene& scene, double seconds, std::int64_t least_contact) {
  SCOPED_TRACE(static_cast<int>(scene.force.law));
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  sand.start();
  const std::vector<double> times = even_times(seconds);
  const std::int64_t before = allocations_of_this_thread();
  std::int64_t contact = 0;
  for (const double t : times) contact += sand.feel(t, {SmoothHand::at(t)}).force.z() > 0.0;
  EXPECT_EQ(allocations_of_this_thread(), before);
  EXPECT_GT(contact, least_contact);
  sand.finish();
}

TEST_P(LiveTool, TakesNoMemoryInTheLoop) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted under sanitizers";
  Scene scene = small_scene();
  scene.displacement.deposit = Deposit::ahead;
  if (GetParam()) {
    scene.preset = ModelPreset::accurate;
    apply_model_preset(scene);
  }
  expect_no_memory_in_loop(scene, 3.0, 500);
}

TEST(LiveSand, TakesNoMemoryInTheLoopForAToolOfAnyShape) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted under sanitizers";
  for (const ToolShape shape : {ToolShape::cone, ToolShape::plate, ToolShape::rake}) {
    Scene scene = small_scene();
    scene.preset = ModelPreset::accurate;
    apply_model_preset(scene);
    SCOPED_TRACE(static_cast<int>(shape));
    scene.tool.shape = shape;
    scene.tool.height = 0.03;
    for (const ForceLaw law : {ForceLaw::paper, ForceLaw::rft, ForceLaw::archimedes}) {
      scene.force.law = law;
      expect_no_memory_in_loop(scene, 1.0, 100);
    }
  }
}

TEST(LiveSand, IsFeltButNotDisplacedWhereItRelaxesTooSlowly) {
  // Nobody takes what is displaced: when the way to the relaxing bed is full, the tool stops displacing, and
  // says so; no sand is lost.
  Scene scene = small_scene();
  const HeightField start = starting_bed(scene.bed);
  LiveSand sand(scene, start, {"bed"});
  std::uint32_t flags = 0;
  FeltForce felt;
  for (int k = 0; k < 100'000 && !(flags & deferred_sand); ++k) {
    const double angle = 0.05 * k;
    felt = sand.feel(k * 1e-3,
                     {Eigen::Vector3d(0.1 * std::cos(angle), 0.1 * std::sin(angle), -0.01 - 1e-6 * k)});
    flags |= felt.flags;
  }
  EXPECT_EQ(flags, deferred_sand);
  EXPECT_GT(felt.force.z(), 0.0);
  const LiveSandReport report = sand.finish();
  EXPECT_EQ(report.deferred_ticks, 1);
  EXPECT_LT((sand.bed().grid() - sand.relaxed_bed().grid()).abs().maxCoeff(), 1e-12);
  EXPECT_LT(std::abs(sand.bed().volume() - start.volume()), 1e-13);
}

TEST(LiveSand, FeelsInTheDevicesAxesAndScale) {
  // The operator pushes away (-x of the device): the drag on the hand points back to him (+x).
  Scene scene = small_scene();
  scene.relaxation.rate = 0.0;
  scene.device.scale = 5.0;
  LiveSand sand(scene, starting_bed(scene.bed), {"device"});
  FeltForce felt;
  for (int k = 0; k < 100; ++k) felt = sand.feel(k * 1e-3, {Eigen::Vector3d(0.005 - 1e-4 * k, 0.0, -0.001)});
  EXPECT_GT(felt.force.z(), 0.0);
  const double repulse = repulse_force(0.005, scene.force);
  EXPECT_NEAR(felt.force.z(), repulse, 0.3 * repulse);  // the furrow's own level is lower than the bed's
  EXPECT_NEAR(felt.force.x() / felt.force.z(), scene.force.k_f * 0.5, 1e-9);  // 0.1 m/s x 5
  EXPECT_NEAR(felt.force.y(), 0.0, 1e-12);
}

TEST(LiveSand, AFarJumpDoesNotCarveAcrossTheBed) {
  // Two readings more than the gap threshold apart are not joined.
  Scene scene = small_scene();
  scene.relaxation.rate = 0.0;
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  sand.feel(0.0, {Eigen::Vector3d(-0.1, 0.0, -0.004)});
  sand.feel(0.2, {Eigen::Vector3d(0.1, 0.0, -0.004)});
  EXPECT_EQ(sand.bed()(75, 75), 0.0);
  EXPECT_LT(sand.bed()(75, 25), 0.0);
  EXPECT_LT(sand.bed()(75, 125), 0.0);
}

TEST(LiveSand, BeginsWithTheHandAtRestAfterAGap) {
  // The hand goes at 0.1 m/s through the sand and, after a gap, at the same speed elsewhere. Drag / repulse
  // is k_f v, with v the mean over the readings since the gap: nobody knows how fast the hand was in it.
  for (const double gap : {0.095, 0.105}) {  // s; the threshold is 0.1 s
    Scene scene = small_scene();
    scene.relaxation.rate = 0.0;
    LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
    const auto speed_felt = [&](double t, double x) {
      const Eigen::Vector3d force = sand.feel(t, {Eigen::Vector3d(x, 0.0, -0.005)}).force;
      EXPECT_GT(force.z(), 0.0);
      return -force.x() / (scene.force.k_f * force.z());
    };
    for (int k = 0; k < 20; ++k) EXPECT_NEAR(speed_felt(k * 1e-3, -0.1 + 1e-4 * k), k ? 0.1 : 0.0, 1e-9) << k;
    const double before = 19e-3, x_before = -0.1 + 19e-4, after = before + gap;
    const int window = LiveSand::velocity_window;
    for (int k = 0; k < 10; ++k) {
      const double t = after + k * 1e-3, x = 0.05 + 1e-4 * k;
      const int past = k - window;  // of the readings after the gap; before it where that is negative
      const double t_past = past >= 0 ? t - window * 1e-3 : before + (past + 1) * 1e-3;
      const double x_past = past >= 0 ? x - window * 1e-4 : x_before + (past + 1) * 1e-4;
      const double expected = gap > 0.1 ? (k ? 0.1 : 0.0) : (x - x_past) / (t - t_past);
      EXPECT_NEAR(speed_felt(t, x), expected, 1e-6 * std::abs(expected) + 1e-9) << gap << " s, " << k;
    }
  }
}

TEST(LiveSand, RefusesScenesThatCannotBeFelt) {
  const auto sentence = [](const Scene& scene) -> std::string {
    try {
      LiveSand sand(scene, starting_bed(scene.bed), {"device"});
    } catch (const Error& failure) {
      return failure.what();
    }
    return "";
  };
  Scene dynamic = small_scene(), fitted = small_scene(), cut = small_scene(), ended = small_scene();
  dynamic.device.model = DeviceModel::dynamic;
  fitted.stroke.emplace().placement.plane = StrokePlane::fit;
  cut.stroke.emplace().placement.start = 1.0;
  EXPECT_NE(sentence(dynamic).find("device.model"), std::string::npos);
  EXPECT_NE(sentence(fitted).find("stroke.plane"), std::string::npos);
  EXPECT_NE(sentence(cut).find("stroke.start"), std::string::npos);
  ended.stroke.emplace().placement.stop = 1.0;
  EXPECT_NE(sentence(ended).find("stroke.stop"), std::string::npos);
  EXPECT_EQ(sentence(small_scene()), "");
}

TEST(LiveSand, ReadingsFurtherApartThanATenthOfASecondAreNotJoined) {
  for (const auto& [pause, joined] : {std::pair{0.095, true}, {0.105, false}}) {
    Scene scene = small_scene();
    scene.relaxation.rate = 0.0;
    LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
    sand.feel(0.0, {Eigen::Vector3d(-0.05, 0.0, -0.004)});
    const FeltForce after = sand.feel(pause, {Eigen::Vector3d(0.05, 0.0, -0.004)});
    EXPECT_EQ(sand.bed()(75, 75) < 0.0, joined) << pause;
    EXPECT_EQ(after.force.x() < 0.0, joined) << "a drag of the way across, where there is one";
  }
}

TEST(LiveSand, TheVelocityOfDragIsTheMeanOverTheLastFourReadings) {
  Scene scene = small_scene();
  scene.relaxation.rate = 0.0;
  scene.device.max_force = 0.0;
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  const std::vector<double> times = {0.0, 0.001, 0.003, 0.004, 0.007, 0.0075, 0.009, 0.0101};
  const auto position = [](double t) -> Eigen::Vector3d { return {20.0 * t * t, -0.3 * t, -0.004}; };
  for (std::size_t i = 0; i < times.size(); ++i) {
    const FeltForce felt = sand.feel(times[i], {position(times[i])});
    ASSERT_GT(felt.force.z(), 0.0);
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    if (i > 0) {
      const double before = times[i < 4 ? 0 : i - 4];
      velocity = (position(times[i]) - position(before)) / (times[i] - before);
    }
    const Eigen::Vector2d drag = -scene.force.k_f * felt.force.z() * velocity.head<2>();
    EXPECT_NEAR((felt.force.head<2>() - drag).norm(), 0.0, 1e-12) << i;
  }
}

TEST(LiveSand, NothingIsDisplacedOrRelaxesBeforeTheRecordingBegins) {
  // A run of the recorded stroke begins with the bed as it was, too.
  const Scene scene = small_scene();
  HeightField start = starting_bed(scene.bed);
  start.set(30, 30, 0.05);  // too steep to rest
  LiveSand sand(scene, start, {"bed"});
  sand.start();
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(sand.touches({Eigen::Vector3d(0.0, 0.0, -0.01)}));
    EXPECT_FALSE(sand.touches({Eigen::Vector3d(0.0, 0.0, 0.01)}));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(sand.finish().relaxation.relaxations, 0);
  EXPECT_EQ((sand.bed().grid() - start.grid()).abs().maxCoeff(), 0.0);
}

TEST(LiveSand, BesideTheBedOnlyWhatIsAboveItsHighestSandIsOutOfTheSand) {
  const Scene scene = small_scene();  // to x = 0.15 m, level at 0
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  const auto out = [&](double x, double z) {
    const DeviceReading reading{{x, 0.0, z}};
    const bool touches = sand.touches(reading);
    EXPECT_EQ(sand.feel(0.0, reading).is_above_or_in_sand, !touches);  // there is no sand to be in
    return !touches;
  };
  EXPECT_TRUE(out(0.2, 0.001));
  EXPECT_FALSE(out(0.2, -0.065));
  EXPECT_FALSE(out(-5.0, -1e-6));
  EXPECT_TRUE(out(0.1, 0.001));
}

TEST(LiveSand, CountsTheTicksInContact) {
  Scene scene = small_scene();
  scene.relaxation.rate = 0.0;
  LiveSand sand(scene, starting_bed(scene.bed), {"bed"});
  int contact = 0;
  for (int k = 0; k < 300; ++k)
    contact += sand.feel(1e-3 * k, {Eigen::Vector3d(0.0, 0.0, k < 100 ? 0.001 : -0.001)}).force.z() > 0.0;
  EXPECT_EQ(contact, 200);
  const LiveSandReport report = sand.finish();
  EXPECT_EQ(report.contact_ticks, 200);
  EXPECT_EQ(report.deferred_ticks, 0);
}

}  // namespace
}  // namespace sandstroke
