#include "validation/stress/loop_theory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandstroke {
namespace {

/// Damped by 10 N s/m in all, against a wall.
LoopSettings wall(double stiffness, double damping, double mass) {
  LoopSettings loop;
  loop.device = ideal_device();
  loop.device.mass = mass;
  loop.device.damping = 10.0;
  loop.device.hand_damping = loop.device.hand_stiffness = 0.0;
  loop.against = Wall{stiffness, damping};
  return loop;
}

constexpr double T = 1e-3, b = 10.0;
constexpr double no_mass = 1e-5;  // kg: its speed follows the force within a hundredth of a tick

TEST(SpectralRadius, GrowsAsTheDeterminantSaysForAFreeMassBetweenSprings) {
  LoopSettings loop = wall(500.0, 0.0, 0.25);
  loop.device.damping = 0.0;
  EXPECT_NEAR(spectral_radius(loop), std::sqrt(1.0 + 500.0 * T * T / (2.0 * 0.25)), 1e-12);
}

TEST(SpectralRadius, BoundaryOfALateSpringWithoutMassIsLevinAndMays) {
  // x(k+1) = x(k) - K T/b x(k-n) is stable up to K T/b = 2 cos(n pi / (2n + 1)) (Levin & May 1976).
  for (const int delay : {0, 1, 2, 5, 20}) {
    LoopSettings loop = wall(1.0, 0.0, no_mass);
    loop.device.delay = delay;
    const double closed = 2.0 * std::cos(delay * std::numbers::pi / (2 * delay + 1)) * b / T;
    EXPECT_NEAR(exact_boundary_gain(loop) / closed, 1.0, 3e-3) << delay;
  }
}

TEST(SpectralRadius, BoundaryOfSampledDragOnAFreeMass) {
  // v(k+1) = a v - (1 - a) B/b v with a = exp(-b T/m) reaches -1 at B = b coth(b T / 2m).
  for (const double mass : {no_mass, 0.01, 0.25}) {
    const LoopSettings loop = wall(0.0, 1.0, mass);
    const double closed = b / std::tanh(b * T / (2.0 * mass));
    EXPECT_LT(spectral_radius(with_gain(loop, 0.999 * closed)), 1.0 + 1e-12);
    EXPECT_GT(spectral_radius(with_gain(loop, 1.001 * closed)), 1.0 + 1e-9);
  }
}

TEST(SpectralRadius, ImplicitDragIsStableWhateverItsStrength) {
  for (const double rate : {20.0, 1000.0, 20e3})
    for (const double k_f : {1.0, 1e3, 1e6, 1e9})
      for (const DragDirection direction : {DragDirection::horizontal, DragDirection::full}) {
        LoopSettings loop;
        loop.device.model = DeviceModel::dynamic;
        loop.device.servo_rate = rate;
        loop.device.drag = DragVelocity::implicit;
        PressedSand sand;
        sand.force.k_f = k_f;
        sand.force.k_s = 10.0;
        sand.force.drag = direction;
        sand.depth = 0.01;
        loop.against = sand;
        EXPECT_LE(spectral_radius(loop), 1.0) << rate << " Hz, k_f " << k_f;
      }
}

TEST(PassivityMargin, CountsTheDelayAndTheWorseAxis) {
  LoopSettings loop = wall(2000.0, 0.5, 0.25);
  EXPECT_NEAR(passivity_margin(loop), b - (2000.0 * T / 2.0 + 0.5), 1e-12);
  loop.device.delay = 3;
  EXPECT_NEAR(passivity_margin(loop), b - (2000.0 * T * 3.5 + 0.5), 1e-12);
}

TEST(OldestForce, IsDelayAndLongestRowOfDroppedTicks) {
  LoopSettings loop = wall(1.0, 0.0, 0.25);
  loop.device.delay = 4;
  EXPECT_DOUBLE_EQ(oldest_force(loop.device, 1000), 5.0 * T);
  loop.device.dropped_ticks = 0.5;
  int row = 0, longest = 0;
  for (int k = 0; k < 1000; ++k) longest = std::max(longest, row = drops_tick(k, 0.5) ? row + 1 : 0);
  EXPECT_GT(longest, 4);
  EXPECT_DOUBLE_EQ(oldest_force(loop.device, 1000), (5.0 + longest) * T);
}

TEST(MeanGrowthWithDrops, IsTheEigenvalueIfNothingDrops) {
  for (const double stiffness : {1e3, 1e4, 1e5}) {
    const LoopSettings loop = wall(stiffness, 0.0, 0.25);
    EXPECT_NEAR(std::log(mean_growth_with_drops(loop)), std::log(spectral_radius(loop)), 2e-4) << stiffness;
  }
}

TEST(SwingOfEncoders, IsOneStepWithoutMass) {
  // x(k+1) = x(k) - K T/b (x(k) + e(k)): what one rounding moves decays by 1 - K T/b; in all, e itself.
  LoopSettings loop = wall(2000.0, 0.0, no_mass);
  loop.device.resolution = 1e-5;
  EXPECT_NEAR(swing_of_encoders(loop), 1e-5, 2e-8);
}

}  // namespace
}  // namespace sandstroke
