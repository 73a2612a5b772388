#include "sand/region_values.h"

#include <gtest/gtest.h>

#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

SandRegion dense(double x, double width, double density) {
  SandRegion region;
  region.centre = {x, 0.0};
  region.size = {width, 10.0};
  region.density = density;
  return region;
}

RegionValues densities(const std::vector<SandRegion>& regions, double blend) {
  return {regions, [](const SandRegion& region) { return region.density; }, blend};
}

TEST(RegionValues, GoOverLinearlyAroundAnEdge) {
  const RegionValues values = densities({dense(0.5, 1.0, 3.0)}, 0.2);  // from x = 0 on
  EXPECT_EQ(values.at({-0.11, 0.0}, 1.0), 1.0);
  EXPECT_EQ(values.at({0.11, 0.0}, 1.0), 3.0);
  EXPECT_NEAR(values.at({0.0, 0.0}, 1.0), 2.0, 1e-15);
  EXPECT_NEAR(values.at({0.05, 0.0}, 1.0), 2.5, 1e-15);
}

TEST(RegionValues, AWiderSoftEdgeStays) {
  SandRegion soft = dense(0.5, 1.0, 3.0);
  soft.soft = 0.4;
  EXPECT_NEAR(densities({soft}, 0.1).at({0.1, 0.0}, 1.0), 2.5, 1e-15);
}

TEST(RegionValues, LaterRegionsLieOverEarlierOnesAndOthersDoNotCount) {
  SandRegion without = dense(0.0, 10.0, 0.0);
  without.density.reset();
  const RegionValues values = densities({dense(0.0, 2.0, 3.0), dense(0.0, 1.0, 5.0), without}, 0.01);
  EXPECT_EQ(values.at({0.0, 0.0}, 1.0), 5.0);
  EXPECT_EQ(values.at({0.7, 0.0}, 1.0), 3.0);
  EXPECT_TRUE(densities({without}, 0.01).empty());
}

TEST(RegionValues, OfAToolsElementsAreThoseOfTheirPlaces) {
  ToolSettings plate;
  plate.shape = ToolShape::plate;
  plate.width = 0.1;
  plate.thickness = 0.2;
  ToolElements elements(tool_surface(plate), 0.01);
  elements.turn(Eigen::Matrix3d::Identity());
  SandRegion corner = dense(0.0, 1.0, 7.0);
  corner.shape = RegionShape::polygon;
  corner.points = {{-0.3, 0.0}, {0.3, 0.0}, {0.0, 0.3}};
  const RegionValues values = densities({dense(0.5, 1.0, 3.0), corner}, 0.02);
  std::vector<double> found(elements.size());
  for (const Eigen::Vector2d& tip : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(-0.8, -0.2),
                                     Eigen::Vector2d(0.5, -0.3), Eigen::Vector2d(0.02, 0.13)}) {
    values.fill(elements, tip, 1.0, found.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(elements.count()); ++i)
      ASSERT_EQ(found[i], values.at(tip + Eigen::Vector2d(elements.x()[i], elements.y()[i]), 1.0)) << i;
  }
}

}  // namespace
}  // namespace sandstroke
