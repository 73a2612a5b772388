// What a bed's floor and its stones do to devices.
#include "sim/floor_force.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "sand/ground.h"
#include "sim/simulation.h"
#include "sim/stepped_simulation.h"
#include "sim/told.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
constexpr double nothing = -std::numeric_limits<double>::infinity();

Scene floor_scene(DeviceModel model) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.12;
  scene.bed.cols = scene.bed.rows = 60;
  scene.tool.radius = 0.006;
  scene.device = ideal_device();
  scene.device.model = model;
  scene.relaxation.rate = 0.0;  // the tool's own part alone
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  return scene;
}

/// Sand up to z = 0 over a floor [m].
template <class FloorOf>
HeightField bed_over(const Scene& scene, const FloorOf& floor_of) {
  HeightField bed = starting_bed(scene.bed);
  const auto ground = std::make_shared<Ground>(bed, 0.6);
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col)
      if (const double floor = floor_of(bed.x_of(col), bed.y_of(row)); floor > nothing)
        ground->floor.set(row, col, floor);
  bed.lie_on(ground);
  return bed;
}
double upright_box(double x, double y) { return std::max(std::abs(x), std::abs(y)) < 0.02 ? 0.03 : nothing; }
double round_stone(double x, double y) {
  const double square = 0.02 * 0.02 - x * x - y * y;
  return square > 0.0 ? std::sqrt(square) : nothing;
}

/// From one point to the next at this speed [m/s], and a second of rest.
Stroke straight(const Vector3d& from, const Vector3d& to, double speed) {
  Stroke stroke;
  const double time = (to - from).norm() / speed;
  stroke.time = {0.0, time, time + 1.0};
  stroke.position = {from, to, to};
  stroke.gap_threshold = 1e9;
  return stroke;
}

struct Played {
  Told told;
  RunResult result;
};
Played play(const Scene& scene, const HeightField& bed, const Stroke& stroke) {
  Played played;
  played.result = Simulation(scene, bed, stroke).run({&played.told});
  return played;
}

TEST(FloorForce, ADeviceRestsWhereTheStoneCarriesTheHand) {
  const Scene scene = floor_scene(DeviceModel::dynamic);
  const HeightField bed = bed_over(scene, [](double, double) { return 0.0; });
  const Played played = play(scene, bed, straight({0.0031, 0.0, 0.01}, {0.0031, 0.0, -0.01}, 0.05));
  const double hand = scene.device.hand_stiffness, stone = scene.ground.stiffness,
               rest = 0.01 * hand / (hand + stone);
  const TickRecord& last = played.told.ticks.back();
  EXPECT_NEAR(last.device_position.z(), -rest, 1e-7);
  EXPECT_NEAR(last.floor_depth, rest, 1e-7);
  EXPECT_NEAR(last.device_force.z(), hand * (0.01 - rest), 1e-4);
  EXPECT_EQ(played.result.displaced_volume, 0.0) << "there is no sand";
  EXPECT_LT(last.depth, 1e-12) << "nor any to be deep in";
  EXPECT_FALSE(played.result.device.swings_from);
}

TEST(FloorForce, AUprightSideStopsADeviceAndDoesNotThrowItUp) {
  const Scene scene = floor_scene(DeviceModel::dynamic);
  const HeightField bed = bed_over(scene, upright_box);
  const Played played = play(scene, bed, straight({0.04, 0.003, 0.005}, {0.01, 0.003, 0.005}, 0.1));
  const double hand = scene.device.hand_stiffness, stone = scene.ground.stiffness, touches = 0.026,
               rest = (touches - 0.01) * hand / (hand + stone);
  const TickRecord& last = played.told.ticks.back();
  EXPECT_NEAR(last.device_position.x(), touches - rest, 1e-6);
  for (const TickRecord& tick : played.told.ticks) {
    EXPECT_NEAR(tick.device_position.z(), 0.005, 1e-4);
    EXPECT_GT(tick.device_position.x(), 0.016) << "never through it";
  }
}

TEST(FloorForce, AKinematicDeviceGoesThroughAndIsToldByTheForce) {
  Scene scene = floor_scene(DeviceModel::kinematic);
  scene.device.max_force = 5.0;
  const HeightField bed = bed_over(scene, [](double, double) { return 0.0; });
  const Played played = play(scene, bed, straight({0.0, 0.0, 0.002}, {0.0, 0.0, -0.008}, 0.05));
  for (const TickRecord& tick : played.told.ticks) {
    const double depth = std::max(-tick.device_position.z(), 0.0);
    EXPECT_NEAR(tick.floor_depth, depth, 1e-15);
    EXPECT_NEAR(tick.floor_force.z(), scene.ground.stiffness * depth, 1e-11);
    EXPECT_NEAR(tick.device_force.z(), std::min(scene.ground.stiffness * depth, 5.0), 1e-11);
    EXPECT_EQ(tick.saturated, scene.ground.stiffness * depth > 5.0);
  }
  EXPECT_NEAR(played.result.device.most_floor_depth, 0.008, 1e-12);
  const auto first = std::find_if(played.told.ticks.begin(), played.told.ticks.end(),
                                  [](const TickRecord& tick) { return tick.device_position.z() < 0.0; });
  EXPECT_EQ(played.result.device.in_floor_from, first->time);
}

TEST(FloorForce, ABuriedStoneIsFeltAtItsDepth) {
  const Scene scene = floor_scene(DeviceModel::kinematic);
  const auto box = [](double x, double y) { return upright_box(x, y) - 0.035; };
  const auto ball = [](double x, double y) { return round_stone(x, y) - 0.025; };
  for (const HeightField& bed : {bed_over(scene, box), bed_over(scene, ball)}) {
    const Played played = play(scene, bed, straight({0.0, 0.0, 0.002}, {0.0, 0.0, -0.006}, 0.005));
    double felt_at = 0.0;
    for (const TickRecord& tick : played.told.ticks)
      if (felt_at == 0.0 && tick.floor_depth > 0.0) felt_at = tick.device_position.z();
    EXPECT_NEAR(felt_at, -0.005, 1e-4);
  }
}

TEST(FloorForce, SandsDepthCountsUntilTheStone) {
  const Scene scene = floor_scene(DeviceModel::kinematic);
  const HeightField bed = bed_over(scene, [](double, double) { return -0.003; });
  const Played played = play(scene, bed, straight({0.0, 0.0, 0.002}, {0.0, 0.0, -0.01}, 0.05));
  for (const TickRecord& tick : played.told.ticks) EXPECT_LE(tick.depth, 0.003 + 1e-12);
}

TEST(FloorForce, NoStoneGivesEnergy) {
  for (const double stiffness : {200.0, 1000.0, 1990.0})
    for (const bool is_round : {false, true})
      for (const double aside : {0.0, 0.004, 0.011}) {
        Scene scene = floor_scene(DeviceModel::dynamic);
        scene.ground.stiffness = stiffness;  // below 2 b / T, where a sampled spring begins to give energy
        scene.device.hand_stiffness = scene.device.hand_damping = 0.0;
        scene.force.k_s = scene.force.k_f = 0.0;
        const HeightField bed = is_round ? bed_over(scene, round_stone) : bed_over(scene, upright_box);
        const Played played =
            play(scene, bed, straight({0.03 + aside, 0.001, 0.04}, {0.0 + aside, 0.001, 0.01}, 0.3));
        // Of what it had, damping takes b v^2, and a spring whose force lasts a tick gives K q^2 / 2 at most.
        const double tick_time = 1.0 / scene.device.servo_rate;
        const auto way = [&](std::size_t i) -> Vector3d {
          return played.told.ticks[i].device_position - played.told.ticks[i - 1].device_position;
        };
        const auto energy = [&](std::size_t i) {
          return 0.5 * scene.device.mass * way(i).squaredNorm() / (tick_time * tick_time);
        };
        double bound = energy(1), touched = 0.0;
        for (std::size_t i = 2; i < played.told.ticks.size(); ++i) {
          const double depth = played.told.ticks[i - 1].floor_depth;
          touched = std::max(touched, depth);
          bound += ((depth > 0.0 ? 0.5 * stiffness : 0.0) - scene.device.damping / tick_time) *
                   way(i).squaredNorm();
          ASSERT_LT(energy(i) + 0.5 * stiffness * depth * depth, bound + 0.02 * energy(1));
        }
        EXPECT_GT(touched, 1e-4);
      }
}

TEST(FloorForce, AToolThatGlancesOffAStoneDoesNotSwingByItself) {
  for (const double speed : {0.02, 0.1, 0.4})
    for (const double height : {0.0, 0.01, 0.018})
      for (const double aside : {0.0, 0.006, 0.02}) {
        const Scene scene = floor_scene(DeviceModel::dynamic);
        const Played played = play(scene, bed_over(scene, round_stone),
                                   straight({-0.045, aside, height}, {0.045, aside, height}, speed));
        EXPECT_FALSE(played.result.device.swings_from) << speed << ", " << height << ", " << aside;
      }
}

TEST(FloorForce, RefusesAStiffnessThatWouldCreateEnergy) {
  Scene scene = floor_scene(DeviceModel::dynamic);
  scene.ground.floor = -0.01;
  const double bound = 2.0 * (scene.device.damping + scene.device.hand_damping) * scene.device.servo_rate;
  const auto is_refused = [&](double stiffness) {
    scene.ground.stiffness = stiffness;
    try {
      check_scene(scene, "a.toml");
    } catch (const Error& error) {
      return std::string(error.what()).find("ground.stiffness") != std::string::npos;
    }
    return false;
  };
  EXPECT_FALSE(is_refused(0.999 * bound));
  EXPECT_TRUE(is_refused(1.001 * bound));
  scene.device.delay = 2;
  EXPECT_TRUE(is_refused(0.201 * bound));
  EXPECT_FALSE(is_refused(0.199 * bound));
  scene.device.model = DeviceModel::kinematic;
  EXPECT_FALSE(is_refused(1.001 * bound));
  scene.device.model = DeviceModel::dynamic;
  scene.ground.floor.reset();
  EXPECT_FALSE(is_refused(1.001 * bound)) << "without a floor it plays no part";
}

TEST(FloorForce, DeepBelowHasTheBitsOfNone) {
  for (const ForceLaw law : {ForceLaw::paper, ForceLaw::rft, ForceLaw::archimedes}) {
    Scene scene = floor_scene(DeviceModel::dynamic);
    scene.force.law = law;
    const Stroke stroke = straight({-0.03, 0.0, 0.005}, {0.03, 0.004, -0.008}, 0.1);
    HeightField deep = starting_bed(scene.bed);
    deep.lie_on(std::make_shared<Ground>(deep, -1.0, 0.6));
    const Played without = play(scene, starting_bed(scene.bed), stroke), with = play(scene, deep, stroke);
    ASSERT_EQ(without.told.ticks.size(), with.told.ticks.size());
    for (std::size_t i = 0; i < without.told.ticks.size(); ++i) {
      ASSERT_EQ(without.told.ticks[i].device_force, with.told.ticks[i].device_force);
      ASSERT_EQ(without.told.ticks[i].device_position, with.told.ticks[i].device_position);
      ASSERT_EQ(without.told.ticks[i].depth, with.told.ticks[i].depth);
    }
  }
}

TEST(FloorForce, GoesOnFromAState) {
  Scene scene = floor_scene(DeviceModel::dynamic);
  scene.tool.shape = ToolShape::plate;
  scene.tool.width = 0.02;
  scene.tool.height = 0.02;
  scene.tool.thickness = 0.006;
  scene.displacement.deposit = Deposit::outward;
  const HeightField bed = bed_over(scene, upright_box);
  SteppedSimulation one(scene, bed), other(scene, bed);
  const auto hand_at = [](int tick) {
    Hand hand;
    hand.down = true;
    hand.position = {0.035 - 0.0002 * tick, 0.0, 0.004};
    hand.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.01 * tick, Vector3d::UnitZ()));
    return hand;
  };
  for (int tick = 0; tick < 60; ++tick) one.tick(hand_at(tick), {.orientation = true});
  other.set_state(one.state());
  bool touched = false;
  for (int tick = 60; tick < 120; ++tick) {  // it turns no further
    const TickRecord a = one.tick(hand_at(tick)), b = other.tick(hand_at(tick));
    ASSERT_EQ(a.floor_force, b.floor_force);
    ASSERT_EQ(a.device_position, b.device_position);
    touched |= a.floor_depth > 0.0;
  }
  EXPECT_TRUE(touched);
}

}  // namespace
}  // namespace sandstroke
