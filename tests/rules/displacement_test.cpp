#include "rules/displacement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sandstroke {
namespace {

constexpr double cell = 0.001, radius = 0.01;

struct Result {
  HeightGrid heights;
  double volume;
};
Result press(const DisplacementSettings& settings, const Eigen::Vector3d& motion = {0.0, 0.0, -0.004}) {
  const WallGrid walls = WallGrid::Zero(61, 61);
  Result result{HeightGrid::Zero(61, 61), 0.0};
  const PlainDisplacement plain(ToolProfile::sphere, radius, walls, cell, 0.0, 0.0);
  EXPECT_EQ(plain.sand_level(result.heights), 0.0);
  result.volume = plain.displace(result.heights, -0.004, motion, settings);
  return result;
}
double rho_of(int row, int col) { return cell * std::hypot(row - 30, col - 30); }

TEST(PlainDisplacement, TakesOutTheCapAndKeepsTheVolume) {
  const double h = 0.004, cap = M_PI * h * h * (radius - h / 3.0);
  for (const Deposit deposit : {Deposit::ring, Deposit::ahead, Deposit::outward}) {
    const Result result = press({deposit});
    EXPECT_NEAR(result.volume, cap, 0.02 * cap);
    EXPECT_NEAR(result.heights.sum() * cell * cell, 0.0, 1e-12 * cap);
  }
}

TEST(PlainDisplacement, DepositsOnTheRingInProportionToThePositiveFilter) {
  const Result result = press({Deposit::ring});
  const auto per_filter = [&](int row, int col) {
    const double rho = rho_of(row, col);
    return result.heights(row, col) / filter::positive(filter::u_of(rho * rho, radius));
  };
  const double factor = per_filter(30, 42);
  EXPECT_GT(factor, 0.0);
  EXPECT_NEAR(per_filter(30, 44), factor, 1e-12 * factor);
  EXPECT_NEAR(per_filter(39, 39), factor, 1e-12 * factor);
  EXPECT_EQ(result.heights(30, 46), 0.0);  // beyond the ring
}

TEST(PlainDisplacement, AheadLeavesTheRingsRearEmptyInADrag) {
  const Result result = press({Deposit::ahead}, {0.001, 0.0, 0.0});
  EXPECT_GT(result.heights(30, 42), 0.0);
  EXPECT_EQ(result.heights(30, 18), 0.0);
}

TEST(PlainDisplacement, OutwardDepositsAroundItsDistance) {
  const Result result = press({Deposit::outward, 1.2});
  for (int row = 0; row < 61; ++row)
    for (int col = 0; col < 61; ++col)
      if (result.heights(row, col) > 0.0) {
        EXPECT_NEAR(rho_of(row, col), 0.012, 1.5 * cell);
      }
}

}  // namespace
}  // namespace sandstroke
