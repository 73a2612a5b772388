#include "haptics/loop_stability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <numbers>

namespace sandstroke {
namespace {

DeviceSettings held_device(double rate, int delay) {
  DeviceSettings device = ideal_device();
  device.servo_rate = rate;
  device.delay = delay;
  return device;
}

/// The distance [m] of a device from its rest after this many ticks, by running the loop tick by tick,
/// without a matrix.
double off_rest(const DeviceSettings& settings, const FeltSand& felt, int window, int ticks) {
  const SimulatedDevice::State rest{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  SimulatedDevice device(settings, {{1e-3, 0.0, 0.0}, Eigen::Vector3d::Zero()});
  std::deque<double> past(static_cast<std::size_t>(window), 0.0);
  std::deque<double> forces(static_cast<std::size_t>(settings.delay), 0.0);
  for (int k = 0; k < ticks; ++k) {
    const double x = device.state().position.x();
    const double velocity = (x - past.back()) * settings.servo_rate / window;
    past.pop_back();
    past.push_front(x);
    forces.push_back(-felt.stiffness * x - felt.drag * velocity);
    device.advance(rest, rest, {forces.front(), 0.0, 0.0});
    forces.pop_front();
  }
  return device.state().position.x();
}

TEST(LoopStability, TheMapIsTheLoopTickByTick) {
  for (const auto& [delay, window] : {std::pair{0, 1}, {0, 4}, {1, 4}, {3, 2}}) {
    const DeviceSettings device = held_device(1000.0, delay);
    const FeltSand felt{700.0, 30.0};
    const Eigen::MatrixXd map = loop_map(device, windowed_feedback(felt, window, 1000.0));
    Eigen::VectorXd state = Eigen::VectorXd::Zero(map.rows());
    state[0] = 1e-3;
    for (int k = 0; k < 50; ++k) state = (map * state).eval();
    EXPECT_NEAR(state[0], off_rest(device, felt, window, 50), 1e-15) << delay << " " << window;
  }
}

TEST(LoopStability, ALoopGrowsBeyondItsBoundaryAndDiesBelowIt) {
  for (const int delay : {0, 1, 4}) {
    const DeviceSettings device = held_device(1000.0, delay);
    const FeltSand most = stable_sand(device, DragDirection::horizontal, 0.0, 4);
    const auto grows = [&](const FeltSand& felt) {
      return std::abs(off_rest(device, felt, 4, 20'000)) > 1e-3;
    };
    EXPECT_TRUE(grows({1.03 * most.stiffness, 0.0})) << delay;
    EXPECT_FALSE(grows({0.97 * most.stiffness, 0.0})) << delay;
    EXPECT_TRUE(grows({0.0, 1.03 * most.drag})) << delay;
    EXPECT_FALSE(grows({0.0, 0.97 * most.drag})) << delay;
  }
}

TEST(LoopStability, DragThatLagsIsBoundedByMassOverLag) {
  // m v' = -B (v, lag late, its mean over a window) is stable up to the frequency w at which the drag comes a
  // quarter of a period late, B sinc(w window / 2) = m w. The lag is the delay, half a tick of holding and
  // half of the window. Without hand or damping.
  for (const auto& [delay, window] : {std::pair{12, 1}, {6, 12}, {1, 18}}) {
    DeviceSettings device = held_device(3e3, delay);
    device.damping = device.hand_damping = device.hand_stiffness = 0.0;
    const double lag = (delay + 0.5 + 0.5 * window) / device.servo_rate;
    const double w = 0.5 * std::numbers::pi / lag, half_window = 0.5 * w * window / device.servo_rate;
    const double closed = device.mass * w * half_window / std::sin(half_window);
    EXPECT_NEAR(stable_sand(device, DragDirection::horizontal, 0.0, window).drag / closed, 1.0, 2e-3)
        << delay << " " << window;
  }
}

TEST(LoopStability, DragInZCountsWhereItIsDragged) {
  const DeviceSettings device = held_device(1000.0, 1);
  const double alone = stable_sand(device, DragDirection::horizontal, 80.0, 4).stiffness;
  EXPECT_NEAR(stable_sand(device, DragDirection::full, 0.0, 4).stiffness, alone, 1e-6 * alone);
  EXPECT_GT(std::abs(stable_sand(device, DragDirection::full, 80.0, 4).stiffness / alone - 1.0), 0.05);
}

}  // namespace
}  // namespace sandstroke
