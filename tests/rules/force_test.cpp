#include "rules/force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <new>
#include <random>

namespace sandstroke {
namespace {

const ForceSettings paper;  // the paper's constants

TEST(RepulseForce, SixMillimetresGiveThreeNewtons) {
  EXPECT_NEAR(repulse_force(0.006, paper), 3.0, 0.005);  // "up to 3 N", closing section
  EXPECT_NEAR(repulse_force(0.006, paper), 3.0045045033770,
              1e-12);  // 1000 (0.003 + 0.003^2/2 + 0.003^3/6 + ...)
}

TEST(RepulseForce, IsZeroAtAndAboveTheSurface) {
  EXPECT_EQ(repulse_force(0.0, paper), 0.0);
  EXPECT_EQ(repulse_force(-0.01, paper), 0.0);
}

TEST(RepulseForce, KeepsItsDigitsAtTinyDepths) {
  EXPECT_NEAR(repulse_force(1e-12, paper) / 5e-10, 1.0, 1e-12);  // exp(x) - 1 would lose 4 of them
}

TEST(RepulseForce, GrowsWithDepthAndInverts) {
  double last = 0.0;
  for (double depth = 1e-4; depth < 1.0; depth *= 1.5) {
    const double force = repulse_force(depth, paper);
    EXPECT_GT(force, last);
    EXPECT_NEAR(depth_of_repulse_force(force, paper), depth, 1e-14 + 1e-13 * depth);
    last = force;
  }
}

TEST(LengthOf, HasTheSameBitsWhereverTheVectorLiesAndDoesNotOverflow) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-12.0, 12.0);
  alignas(16) double memory[4];
  for (int i = 0; i < 1000; ++i) {
    const double x = any(random), y = any(random), z = any(random);
    const double aligned = length_of(*new (memory) Eigen::Vector3d(x, y, z));
    const double beside = length_of(*new (memory + 1) Eigen::Vector3d(x, y, z));
    EXPECT_EQ(aligned, beside);
    EXPECT_NEAR(aligned, std::sqrt(x * x + y * y + z * z), 1e-14 * aligned);
  }
  EXPECT_DOUBLE_EQ(length_of({3e200, 0.0, -4e200}), 5e200);
}

TEST(SandForce, DragOpposesHorizontalMotion) {
  const SandForce f = sand_force(0.006, {0.1, -0.2, 0.3}, 0.0, paper);
  const double r = 1000.0 * (std::exp(0.003) - 1.0);
  EXPECT_NEAR(f.repulse, r, 1e-12);
  EXPECT_NEAR(f.drag.x(), -10.0 * 0.1 * r, 1e-12);
  EXPECT_NEAR(f.drag.y(), 10.0 * 0.2 * r, 1e-12);
  EXPECT_EQ(f.drag.z(), 0.0);
  EXPECT_NEAR(f.total.z(), r, 1e-12);
  EXPECT_FALSE(f.saturated);
}

TEST(SandForce, FullDragTakesAllComponents) {
  ForceSettings full;
  full.drag = DragDirection::full;
  const SandForce f = sand_force(0.006, {0.0, 0.0, -0.3}, 0.0, full);
  EXPECT_NEAR(f.drag.z(), 3.0 * f.repulse, 1e-12);
}

TEST(SandForce, IsLimitedInMagnitudeAndKeepsItsDirection) {
  const SandForce free = sand_force(0.05, {0.2, 0.1, 0.0}, 0.0, paper);
  const SandForce limited = sand_force(0.05, {0.2, 0.1, 0.0}, 12.0, paper);
  EXPECT_TRUE(limited.saturated);
  EXPECT_NEAR(limited.total.norm(), 12.0, 1e-12);
  EXPECT_NEAR(limited.total.normalized().dot(free.total.normalized()), 1.0, 1e-14);
  EXPECT_EQ(limited.repulse, free.repulse);
}

TEST(SandForce, IsCutFromItsLimitOn) {
  for (const Eigen::Vector3d& velocity : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.03, -0.04, 0.7)}) {
    // k_f v is 0 or 1/2 along the sand, so that the whole is sqrt(1 + 1/4) of repulse.
    const double whole = std::hypot(1.0, 10.0 * velocity.head<2>().norm());
    for (const double fraction : {0.95, 1.05}) {
      const double depth = depth_of_repulse_force(fraction * 12.0 / whole, paper);
      const SandForce force = sand_force(depth, velocity, 12.0, paper);
      EXPECT_EQ(force.saturated, fraction > 1.0);
      EXPECT_NEAR(force.total.norm(), 12.0 * std::min(fraction, 1.0), 1e-12);
    }
  }
}

TEST(FeltSand, IsTheSlopeOfItsForces) {
  const double depth = 0.02, scale = 3.0, step = 1e-5;
  const FeltSand felt = felt_sand(depth, repulse_force(depth, paper), scale, paper);
  // A metre of the device is `scale` of the bed.
  const double rise = repulse_force(depth + scale * step, paper) - repulse_force(depth - scale * step, paper);
  EXPECT_NEAR(felt.stiffness, rise / (2.0 * step), 1e-6 * felt.stiffness);
  const double speed = 0.1;  // m/s of the device
  EXPECT_NEAR(felt.drag * speed, -sand_force(depth, {scale * speed, 0.0, 0.0}, 0.0, paper).drag.x(), 1e-12);
  const FeltSand air = felt_sand(-1e-9, 0.0, scale, paper);
  EXPECT_EQ(air.stiffness, 0.0);
  EXPECT_EQ(air.drag, 0.0);
  EXPECT_EQ(felt_sand(0.0, 0.0, scale, paper).stiffness, 0.0);  // at the surface: above the sand
}

TEST(SandForce, IsDefinedAtAnyDepthOnALimitedDevice) {
  // exp(k_c d) overflows; the limit leaves max_force along e_z - k_f v.
  const Eigen::Vector3d velocity(0.2, 0.0, -0.1);
  const Eigen::Vector3d direction = Eigen::Vector3d(-10.0 * 0.2, 0.0, 1.0).normalized();
  for (const double depth : {1e2, 1e3, 1e4, 1e300}) {
    const SandForce f = sand_force(depth, velocity, 12.0, paper);
    EXPECT_NEAR((f.total - 12.0 * direction).norm(), 0.0, 1e-13);
    EXPECT_TRUE(f.saturated);
    EXPECT_FALSE(f.drag.hasNaN());
  }
  for (const double speed : {1e100, 1e154, 1e300, 1e308}) {
    const SandForce fast = sand_force(0.004, {speed, 0.0, 0.0}, 12.0, paper);
    EXPECT_NEAR((fast.total - Eigen::Vector3d(-12.0, 0.0, 0.0)).norm(), 0.0, 1e-12) << speed;
  }
  const SandForce free = sand_force(1e4, velocity, 0.0, paper);
  EXPECT_EQ(free.total.z(), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(free.total.hasNaN());
}

TEST(SandForce, IsDefinedOnALimitedDeviceWhereInfiniteDragMeetsInfiniteRepulse) {
  ForceSettings full = paper;
  full.drag = DragDirection::full;
  const SandForce rising = sand_force(1e4, {0.0, 0.0, 0.05}, 12.0, full);  // drag is half of repulse
  EXPECT_NEAR((rising.total - Eigen::Vector3d(0.0, 0.0, 12.0)).norm(), 0.0, 1e-13);
}

TEST(SandForce, StaysZeroAtAnyDepthWithoutStiffnessOrDrag) {
  ForceSettings nothing = paper;
  nothing.k_s = 0.0;
  EXPECT_EQ(sand_force(1e4, {0.1, 0.0, 0.0}, 0.0, nothing).total.norm(), 0.0);
  ForceSettings frictionless = paper;
  frictionless.k_f = 0.0;
  EXPECT_EQ(sand_force(1e4, {0.1, 0.0, 0.0}, 12.0, frictionless).drag.norm(), 0.0);
}

TEST(SandForce, IsZeroInTheAir) {
  EXPECT_EQ(sand_force(-1e-9, {1.0, 1.0, 1.0}, 12.0, paper).total.norm(), 0.0);
}

}  // namespace
}  // namespace sandstroke
