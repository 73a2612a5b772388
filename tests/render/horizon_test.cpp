#include "render/horizon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angle.h"

namespace sandstroke {
namespace {

constexpr double cell_size = 0.002;

DrawnHeights visibility(const DrawnHeights& heights, const Sun& sun) {
  DrawnHeights seen = DrawnHeights::Constant(heights.rows(), heights.cols(), -1.0f);
  sun_visibility(heights, cell_size, sun, static_cast<double>(heights.maxCoeff()),
                 {0, static_cast<int>(heights.rows()), 0, static_cast<int>(heights.cols())}, seen);
  return seen;
}

/// High to the left of column `edge`, low from there on.
DrawnHeights cliff(int rows, int cols, int edge, double height) {
  DrawnHeights heights = DrawnHeights::Zero(rows, cols);
  heights.leftCols(edge) = static_cast<float>(height);
  return heights;
}

/// The position where the sun's visibility along a row crosses 1/2, from the shadow into the light, in cells.
double crossing(const DrawnHeights& seen, int row, int from) {
  for (int col = from; col + 1 < seen.cols(); ++col)
    if (seen(row, col) < 0.5f && seen(row, col + 1) >= 0.5f)
      return col + static_cast<double>((0.5f - seen(row, col)) / (seen(row, col + 1) - seen(row, col)));
  return -1.0;
}

TEST(SunVisibility, CliffShadowHasTheLengthOfTheGeometry) {
  const double height = 0.06;
  const int edge = 40;
  for (const double elevation : {8.0, 15.0, 28.0, 45.0, 60.0}) {
    const DrawnHeights seen = visibility(cliff(9, 400, edge, height), Sun{180.0, elevation});
    const double length = height / std::tan(to_radians(elevation)) / cell_size;
    EXPECT_NEAR(crossing(seen, 4, edge), edge - 1 + length, 1.5) << elevation;
  }
}

TEST(SunVisibility, ObliqueSunShortensTheShadowByTheCosine) {
  const double height = 0.06, elevation = 20.0;
  for (const double turn : {-55.0, -30.0, 10.0, 45.0}) {
    const DrawnHeights seen = visibility(cliff(801, 300, 40, height), Sun{180.0 + turn, elevation});
    const double length = height / std::tan(to_radians(elevation)) * std::cos(to_radians(turn)) / cell_size;
    EXPECT_NEAR(crossing(seen, 400, 40), 39 + length, 1.5) << turn;
  }
}

TEST(SunVisibility, PenumbraWidensWithTheSunsSize) {
  const auto width = [](double softness) {
    const DrawnHeights seen = visibility(cliff(5, 300, 40, 0.06), Sun{180.0, 25.0, softness});
    return ((seen > 0.02f) && (seen < 0.98f)).row(2).count();
  };
  EXPECT_GT(width(4.0), 2 * width(1.0));
}

TEST(SunVisibility, PlaneAndSunnySideAreFullyLit) {
  EXPECT_TRUE((visibility(DrawnHeights::Constant(20, 30, 0.3f), Sun{77.0, 5.0}) == 1.0f).all());
  // The sun stands over the low side.
  EXPECT_TRUE((visibility(cliff(20, 60, 30, 0.05), Sun{0.0, 20.0}) == 1.0f).all());
}

TEST(SunVisibility, PartsAgreeWithTheWholeToTheBit) {
  DrawnHeights heights(70, 90);
  for (int row = 0; row < 70; ++row)
    for (int col = 0; col < 90; ++col)
      heights(row, col) = 0.01f * static_cast<float>(std::sin(row * 0.7) * std::cos(col * 0.4));
  const Sun sun{130.0, 12.0};
  const DrawnHeights whole = visibility(heights, sun);
  DrawnHeights parts = DrawnHeights::Zero(70, 90);
  for (int row = 0; row < 70; row += 35)
    for (int col = 0; col < 90; col += 30)
      sun_visibility(heights, cell_size, sun, 0.02, {row, row + 35, col, col + 30}, parts);
  EXPECT_TRUE((parts == whole).all());
}

TEST(SunVisibility, ReachIsHowFarAShadowFalls) {
  const Sun sun{180.0, 30.0, 0.0};
  EXPECT_EQ(shadow_reach(sun, 0.0, cell_size), 0);
  EXPECT_EQ(shadow_reach(sun, 0.06, cell_size),
            static_cast<int>(std::ceil(0.06 / std::tan(to_radians(30.0)) / cell_size)));
}

TEST(SkyVisibility, PlaneSeesAllOfTheSky) {
  DrawnHeights seen = DrawnHeights::Zero(40, 40);
  sky_visibility(DrawnHeights::Constant(40, 40, -0.2f), cell_size, {0, 40, 0, 40}, seen);
  EXPECT_TRUE((seen == 1.0f).all());
}

TEST(SkyVisibility, ValleyOfFortyFiveDegrees) {
  DrawnHeights heights(61, 61);
  for (int col = 0; col < 61; ++col) heights.col(col) = static_cast<float>(std::abs(col - 30) * cell_size);
  DrawnHeights seen = DrawnHeights::Zero(61, 61);
  sky_visibility(heights, cell_size, {0, 61, 0, 61}, seen);
  // Across: 1 - sin 45deg; along: 1; diagonally the slope is 1/sqrt(2).
  const double across = 1.0 - std::sqrt(0.5), diagonal = 1.0 - std::sin(std::atan(std::sqrt(0.5)));
  EXPECT_NEAR(seen(30, 30), (2.0 * across + 2.0 + 4.0 * diagonal) / 8.0, 1e-4);
}

TEST(Sun, DirectionIsAUnitVectorTowardsIt) {
  const Eigen::Vector3d direction = Sun{90.0, 30.0}.direction();
  EXPECT_NEAR((direction - Eigen::Vector3d(0.0, std::sqrt(0.75), 0.5)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace sandstroke
