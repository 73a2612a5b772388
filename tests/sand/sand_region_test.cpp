#include "sand/sand_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rules/talus.h"
#include "sand/make_ground.h"

namespace sandstroke {
namespace {

const BedGeometry bed(70, 130, 0.01);  // more than a tile, and parts of tiles

SandRegion rectangle(double x, double y, double width, double depth, double talus = 35.0) {
  SandRegion region;
  region.centre = {x, y};
  region.size = {width, depth};
  region.talus_angle = talus;
  return region;
}

SandRegion circle(double x, double y, double radius, double talus = 35.0) {
  SandRegion region;
  region.shape = RegionShape::circle;
  region.centre = {x, y};
  region.radius = radius;
  region.talus_angle = talus;
  return region;
}

SandRegion polygon(std::vector<Eigen::Vector2d> points, double talus = 35.0) {
  SandRegion region;
  region.shape = RegionShape::polygon;
  region.points = std::move(points);
  region.talus_angle = talus;
  return region;
}

std::shared_ptr<const Ground> ground_with(std::vector<SandRegion> regions, double talus = 25.0) {
  GroundSettings settings;
  settings.regions = std::move(regions);
  return make_ground(bed, settings, talus_slope(talus));
}

/// The integral of the region's share that the slopes show [m^2].
double area_in(const Ground& ground, double talus = 35.0, double below = 25.0) {
  double sum = 0.0;
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col)
      sum += (ground.talus_slopes(row, col) - talus_slope(below)) / (talus_slope(talus) - talus_slope(below));
  return sum * bed.cell_area();
}

TEST(SandRegion, SharpEdgesKeepTheArea) {
  EXPECT_NEAR(area_in(*ground_with({rectangle(0.013, -0.027, 0.3141, 0.2718)})), 0.3141 * 0.2718, 1e-13);
  for (const double radius : {0.003, 0.0501, 0.2718})
    EXPECT_NEAR(area_in(*ground_with({circle(0.013, -0.0377, radius)})), std::numbers::pi * radius * radius,
                1e-13)
        << radius;
  // An L, turned: it is not convex.
  const Eigen::Rotation2Dd turn(0.4);
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [x, y] :
       {std::pair(0.0, 0.0), {0.3, 0.0}, {0.3, 0.1}, {0.1, 0.1}, {0.1, 0.25}, {0.0, 0.25}})
    corners.push_back(turn * Eigen::Vector2d(x - 0.1, y - 0.1));
  EXPECT_NEAR(area_in(*ground_with({polygon(corners)})), 0.3 * 0.1 + 0.1 * 0.15, 1e-13);
  std::ranges::reverse(corners);
  EXPECT_NEAR(area_in(*ground_with({polygon(corners)})), 0.3 * 0.1 + 0.1 * 0.15, 1e-13);
}

TEST(SandRegion, ASeamInsideACellGivesItsMeanOfTan) {
  // The edge is 0.3 cells beyond the left side of column 65.
  const double edge = bed.x_of(65) - 0.5 * bed.cell_size() + 0.3 * bed.cell_size();
  const auto ground = ground_with({rectangle(edge - 5.0, 0.0, 10.0, 10.0)});
  for (const int row : {0, 69}) {
    EXPECT_EQ(ground->talus_slopes(row, 64), talus_slope(35.0));
    EXPECT_NEAR(ground->talus_slopes(row, 65), 0.3 * talus_slope(35.0) + 0.7 * talus_slope(25.0), 1e-12);
    EXPECT_EQ(ground->talus_slopes(row, 66), talus_slope(25.0));
  }
}

TEST(SandRegion, ASoftEdgeBlendsLinearly) {
  const double soft = 0.08;
  SandRegion region = rectangle(-5.0, 0.0, 10.0, 10.0);
  region.soft = soft;
  const auto ground = ground_with({region});
  for (int col = 0; col < bed.cols(); ++col) {
    const double x = bed.x_of(col);
    if (std::abs(std::abs(x) - 0.5 * soft) < bed.cell_size()) continue;  // the band ends in the cell
    const double share = std::clamp(0.5 - x / soft, 0.0, 1.0);
    EXPECT_NEAR(ground->talus_slopes(30, col), std::lerp(talus_slope(25.0), talus_slope(35.0), share), 1e-12)
        << x;
  }
  // Around a circle, the band's parts inside and outside the edge differ: the integral of the share is
  // pi (r^2 + soft^2 / 12).
  SandRegion round = circle(0.003, 0.004, 0.2);
  round.soft = soft;
  EXPECT_NEAR(area_in(*ground_with({round})), std::numbers::pi * (0.04 + soft * soft / 12.0), 2e-6);
}

TEST(SandRegion, ASoftPolygonIsAsItsRectangle) {
  SandRegion one = rectangle(0.01, 0.02, 0.2, 0.1),
             other = polygon({{-0.09, -0.03}, {0.11, -0.03}, {0.11, 0.07}, {-0.09, 0.07}});
  one.soft = other.soft = 0.05;
  const auto first = ground_with({one}), second = ground_with({other});
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col)
      EXPECT_NEAR(first->talus_slopes(row, col), second->talus_slopes(row, col), 1e-13);
}

TEST(SandRegion, LaterOnesLieOverEarlierOnes) {
  const auto ground = ground_with({circle(0.0, 0.0, 0.3, 35.0), rectangle(0.1, 0.0, 0.2, 0.2, 40.0)});
  EXPECT_EQ(ground->talus_slopes(35, 65 + 10), talus_slope(40.0));
  EXPECT_EQ(ground->talus_slopes(35, 65 - 10), talus_slope(35.0));
  EXPECT_EQ(ground->talus_slopes(0, 0), talus_slope(25.0));
  // The same edge twice: only the later region counts in the cells of the edge.
  const auto twice = ground_with({circle(0.0, 0.0, 0.2003, 35.0), circle(0.0, 0.0, 0.2003, 40.0)});
  EXPECT_NEAR(area_in(*twice, 40.0), std::numbers::pi * 0.2003 * 0.2003, 1e-4);
}

TEST(SandRegion, ARegionOfTheSameSandChangesNoBit) {
  const auto ground = ground_with({circle(0.0, 0.0, 0.2003, 25.0), rectangle(0.2, 0.0, 0.1003, 0.2, 25.0)});
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) ASSERT_EQ(ground->talus_slopes(row, col), talus_slope(25.0));
}

TEST(SandRegion, AllocatesOnlyTheTilesThatItTouches) {
  const BedGeometry huge(65536, 65536, 0.001);
  GroundSettings settings;
  settings.regions = {rectangle(5.0, 5.0, 0.1, 0.1), rectangle(-100.0, 0.0, 1.0, 1.0)};  // the other: outside
  const auto ground = make_ground(huge, settings, 0.5);
  EXPECT_LE(ground->talus_slopes.allocated_tiles(), 9);
  EXPECT_GE(ground->talus_slopes.allocated_tiles(), 4);
  EXPECT_LE(ground->talus_slopes.allocated_tiles(), most_tiles(huge, settings).slopes);
  EXPECT_EQ(ground->floor.allocated_tiles(), 0);
  EXPECT_TRUE(ground->talus_slopes.disturbed_tiles().empty());
}

TEST(SandRegion, KnowsPolygonsThatCrossThemselves) {
  EXPECT_TRUE(crosses_itself({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(crosses_itself({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_FALSE(crosses_itself({{0, 0}, {1, 0}, {0.2, 0.2}, {0, 1}}));
  EXPECT_FALSE(crosses_itself({{0, 0}, {1, 0}, {0, 1}}));
}

}  // namespace
}  // namespace sandstroke
