#include "haptics/simulated_device.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "haptics/passivity.h"
#include "rules/force.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

SimulatedDevice::State resting_at(double z) { return {{0.0, 0.0, z}, Eigen::Vector3d::Zero()}; }

TEST(DevicePresets, HaveThePapersFigures) {
  DeviceSettings settings;
  settings.preset = DevicePreset::omega3;
  apply_device_preset(settings);
  EXPECT_EQ(settings.max_force, 12.0);
  EXPECT_EQ(settings.resolution, 0.009e-3);
  settings.preset = DevicePreset::phantom_desktop;
  apply_device_preset(settings);
  EXPECT_EQ(settings.max_force, 20.0);
  EXPECT_EQ(settings.resolution, 0.03e-3);
}

TEST(DevicePresets, HaveTheMakersFiguresOrNone) {
  DeviceSettings settings;
  settings.preset = DevicePreset::touch;  // 3D Systems: 3.3 N, 0.055 mm
  apply_device_preset(settings);
  EXPECT_EQ(settings.max_force, 3.3);
  EXPECT_EQ(settings.resolution, 0.055e-3);
  settings.preset = DevicePreset::ideal;
  apply_device_preset(settings);
  EXPECT_EQ(settings.max_force, 0.0);
  EXPECT_EQ(settings.resolution, 0.0);
  EXPECT_EQ(ideal_device().max_force, 0.0);
  EXPECT_EQ(ideal_device().model, DeviceModel::dynamic);
}

TEST(TipOf, ScalesAndThenMoves) {
  DeviceSettings settings;
  settings.scale = 4.0;
  settings.offset = {1.0, 2.0, 3.0};
  EXPECT_EQ(tip_of(settings, {0.25, 0.5, -1.0}), Eigen::Vector3d(2.0, 4.0, -1.0));
}

TEST(KinematicDevice, IsWhereTheHandIs) {
  SimulatedDevice device(DeviceSettings{}, resting_at(0.0));
  const SimulatedDevice::State next{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  device.advance(resting_at(0.0), next, {0.0, 0.0, 100.0});
  EXPECT_EQ(device.read().position, next.position);
  EXPECT_EQ(device.read().velocity, next.velocity);
}

TEST(DynamicDevice, MovesWithAUniformHandInSteadyState) {
  // A hand at constant speed leads the device by b v / k_h, for ever.
  DeviceSettings settings = ideal_device();
  const double v = 0.1, lag = settings.damping * v / settings.hand_stiffness;
  SimulatedDevice device(settings, {{-lag, 0.0, 0.0}, {v, 0.0, 0.0}});
  for (int k = 0; k < 1000; ++k)
    device.advance({{v * k / 1000.0, 0, 0}, {v, 0, 0}}, {{v * (k + 1) / 1000.0, 0, 0}, {v, 0, 0}},
                   Eigen::Vector3d::Zero());
  EXPECT_NEAR(device.state().position.x(), v * 1.0 - lag, 1e-13);
  EXPECT_NEAR(device.state().velocity.x(), v, 1e-13);
}

TEST(DynamicDevice, TickMapIsExactWhateverTheRate) {
  // One tick of 10 ms is ten of 1 ms with the same held inputs.
  DeviceSettings slow = ideal_device(), fast = slow;
  slow.servo_rate = 100.0;
  SimulatedDevice one(slow, resting_at(0.01)), ten(fast, resting_at(0.01));
  const Eigen::Vector3d force(0.3, -0.2, 1.5);
  const auto hand = [](double t) {
    return SimulatedDevice::State{{0.1 * t, 0.0, -0.2 * t}, {0.1, 0.0, -0.2}};
  };
  one.advance(hand(0.0), hand(0.01), force);
  for (int k = 0; k < 10; ++k) ten.advance(hand(k * 1e-3), hand((k + 1) * 1e-3), force);
  EXPECT_NEAR((one.state().position - ten.state().position).norm(), 0.0, 1e-15);
  EXPECT_NEAR((one.state().velocity - ten.state().velocity).norm(), 0.0, 1e-13);
}

TEST(DynamicDevice, ReadsItsEncoders) {
  DeviceSettings settings = ideal_device();
  settings.resolution = 3e-5;
  SimulatedDevice device(settings, resting_at(1.234567e-3));
  const double z = device.read().position.z();
  EXPECT_NEAR(z / 3e-5, std::round(z / 3e-5), 1e-9);
  EXPECT_NEAR(z, 1.234567e-3, 1.5e-5);
  EXPECT_EQ(device.state().position.z(), 1.234567e-3);
}

TEST(DynamicDevice, ReadsTheNearestStepOfItsEncoders) {
  DeviceSettings settings = ideal_device();
  settings.resolution = 0.25;
  for (const double z : {0.0, 0.1, 0.12, 0.13, 0.24, -0.12, -0.13, -0.2}) {
    const double read = SimulatedDevice(settings, resting_at(z)).read().position.z();
    EXPECT_EQ(read, std::abs(z) < 0.125 ? 0.0 : std::copysign(0.25, z)) << z;
  }
  settings.model = DeviceModel::kinematic;  // has none
  EXPECT_EQ(SimulatedDevice(settings, resting_at(0.1)).read().position.z(), 0.1);
}

TEST(DynamicDevice, TheHandGoesUniformlyFromPositionToPositionInATick) {
  // Whatever its velocities at either end: they are not asked for.
  const DeviceSettings settings = ideal_device();
  const SimulatedDevice::State from{{0, 0, 0}, {9, 9, 9}}, to{{1e-4, -2e-4, 0}, {-7, 0, 7}};
  SimulatedDevice device(settings, resting_at(0.0));
  device.advance(from, to, Eigen::Vector3d::Zero());
  SimulatedDevice even(settings, resting_at(0.0));
  const Eigen::Vector3d mean(0.1, -0.2, 0.0);
  even.advance({from.position, mean}, {to.position, mean}, Eigen::Vector3d::Zero());
  EXPECT_EQ(device.state().position, even.state().position);
  EXPECT_EQ(device.state().velocity, even.state().velocity);
  EXPECT_EQ(device.drag_velocity(from, to, mean, 1.0),
            device.drag_velocity({from.position, mean}, {to.position, mean}, mean, 1.0));
}

TEST(DynamicDevice, APlungeEqualsAMegahertzIntegration) {
  // The sand's force at flat, undisturbed level 0, updated at 1 kHz and held in between, in both.
  const DeviceSettings settings = ideal_device();
  const ForceSettings force;
  SimulatedDevice device(settings, resting_at(0.002));
  double x = 0.002, v = 0.0;
  const double dt = 1e-6;
  const auto hand_at = [](double t) { return 0.002 - 0.02 * t; };  // 20 mm/s down, for 0.6 s
  double worst = 0.0;
  for (int k = 0; k < 600; ++k) {
    const double t = k * 1e-3;
    const double by_map = repulse_force(-device.read().position.z(), force);
    device.advance({{0, 0, hand_at(t)}, {0, 0, -0.02}}, {{0, 0, hand_at(t + 1e-3)}, {0, 0, -0.02}},
                   {0, 0, by_map});

    const double held = repulse_force(-x, force);
    const auto acceleration = [&](double at, double position, double speed) {
      return (settings.hand_stiffness * (hand_at(at) - position) + settings.hand_damping * (-0.02 - speed) -
              settings.damping * speed + held) /
             settings.mass;
    };
    for (int i = 0; i < 1000; ++i) {  // the classical Runge-Kutta method at 1 MHz
      const double now = t + i * dt;
      const double x1 = v, v1 = acceleration(now, x, v);
      const double x2 = v + 0.5 * dt * v1,
                   v2 = acceleration(now + 0.5 * dt, x + 0.5 * dt * x1, v + 0.5 * dt * v1);
      const double x3 = v + 0.5 * dt * v2,
                   v3 = acceleration(now + 0.5 * dt, x + 0.5 * dt * x2, v + 0.5 * dt * v2);
      const double x4 = v + dt * v3, v4 = acceleration(now + dt, x + dt * x3, v + dt * v3);
      x += dt / 6.0 * (x1 + 2.0 * x2 + 2.0 * x3 + x4);
      v += dt / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    }
    worst = std::max(worst, std::abs(device.state().position.z() - x));
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(device.state().position.z(), -0.003);  // it did enter the sand
}

/// Largest modulus of an eigenvalue of the one-tick map with a spring wall F = -K x closed around it.
double spectral_radius(const DeviceSettings& settings, double stiffness) {
  const Eigen::Matrix<double, 2, 5> map = device_tick_map(settings);
  Eigen::Matrix2d loop = map.leftCols<2>();
  loop.col(0) -= stiffness * map.col(4);
  return loop.eigenvalues().cwiseAbs().maxCoeff();
}

/// True if the device against the wall comes to rest instead of swinging ever further.
bool settles(const DeviceSettings& settings, double stiffness) {
  SimulatedDevice device(settings, resting_at(1e-3));
  for (int k = 0; k < 200'000; ++k) {
    const double force = -stiffness * device.read().position.z();
    device.advance(resting_at(0.0), resting_at(0.0), {0.0, 0.0, force});
    if (std::abs(device.state().position.z()) > 1.0) return false;
  }
  return std::abs(device.state().position.z()) < 1e-3;
}

TEST(DynamicDevice, SpringWallTurnsUnstableWhereTheEigenvalueSays) {
  for (const double rate : sanitized ? std::vector{1000.0} : std::vector{500.0, 1000.0, 4000.0}) {
    DeviceSettings settings = ideal_device();
    settings.servo_rate = rate;
    const auto bisect = [](auto stable) {
      double low = 1.0, high = 1e7;
      while (high / low > 1.0001) (stable(std::sqrt(low * high)) ? low : high) = std::sqrt(low * high);
      return low;
    };
    const double exact = bisect([&](double K) { return spectral_radius(settings, K) < 1.0; });
    const double measured = bisect([&](double K) { return settles(settings, K); });
    EXPECT_NEAR(measured / exact, 1.0, 0.01) << rate;
  }
}

TEST(Passivity, MarginIsColgateAndSchenkels) {
  DeviceSettings device;
  device.scale = 2.0;
  device.damping = 3.0;
  device.hand_damping = 4.0;
  device.servo_rate = 1000.0;
  const ForceSettings force;
  const double depth = 0.006, repulse = repulse_force(depth, force);
  const double K = 2.0 * 1000.0 * 0.5 * std::exp(0.003), B = 2.0 * 10.0 * repulse;
  const FeltSand sand = felt_sand(depth, repulse, device.scale, force);
  EXPECT_NEAR(passivity_margin(sand.stiffness, sand.drag, device), 7.0 - (K * 1e-3 / 2.0 + B), 1e-12);
  EXPECT_EQ(passivity_margin(0.0, 0.0, device), 7.0);
  device.delay = 3;  // a spring that acts three ticks late is (1/2 + 3) T old on average
  EXPECT_NEAR(passivity_margin(sand.stiffness, sand.drag, device), 7.0 - (K * 3.5e-3 + B), 1e-12);
}

TEST(EnergyAccount, CountsWhatTheDeviceGives) {
  EnergyAccount account;
  account.add({0, 0, 2.0}, {0, 0, -0.5});  // pushed down against an upward force: 1 J into the sand
  EXPECT_DOUBLE_EQ(account.absorbed(), 1.0);
  account.add({0, 0, 2.0}, {0, 0, 0.75});  // pushed back up: 1.5 J returned
  EXPECT_DOUBLE_EQ(account.absorbed(), -0.5);
  EXPECT_DOUBLE_EQ(account.least(), -0.5);
  account.add({3.0, 0, 2.0}, {-1.0, 0, 0.0});  // dragged against the drag
  EXPECT_DOUBLE_EQ(account.absorbed(), 2.5);
  EXPECT_DOUBLE_EQ(account.least(), -0.5);  // is not forgotten
  EXPECT_EQ(EnergyAccount{}.least(), 0.0);
}

TEST(SimulatedDevice, DifferentiatesReadPositionsWithEncoders) {
  DeviceSettings settings = ideal_device();
  settings.velocity = ReadVelocity::encoders;
  settings.velocity_window = 4;
  for (const double resolution : {0.0, 55e-6}) {
    settings.resolution = resolution;
    SimulatedDevice::State hand{Eigen::Vector3d::Zero(), {0.1, 0.0, -0.2}};
    SimulatedDevice device(settings, hand);
    std::vector<Eigen::Vector3d> read;
    for (int k = 0; k < 50; ++k) {
      read.push_back(device.read().position);
      const int known = std::min(k, 4);
      Eigen::Vector3d expected = Eigen::Vector3d::Zero();
      if (known > 0) expected = (read.back() - read[read.size() - 1 - known]) * 1000.0 / known;
      EXPECT_NEAR((device.read().velocity - expected).norm(), 0.0, 1e-12) << k;
      SimulatedDevice::State next = hand;
      next.position += 1e-3 * hand.velocity;
      device.advance(hand, next, Eigen::Vector3d::Zero());
      hand = next;
    }
    device.put(hand);
    EXPECT_EQ(device.read().velocity, Eigen::Vector3d::Zero()) << "nothing is known of the way there";
  }
}

}  // namespace
}  // namespace sandstroke
