#include "tool/tool_width.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

constexpr double whole_tool = std::numeric_limits<double>::infinity();

ToolSettings shaped(ToolShape shape) {
  ToolSettings tool;
  tool.shape = shape;
  return tool;
}

TEST(ToolWidth, IsTheLeastDimensionOfEachShapeByFormula) {
  ToolSettings plate = shaped(ToolShape::plate), box = shaped(ToolShape::box), rake = shaped(ToolShape::rake),
               cylinder = shaped(ToolShape::cylinder);
  plate.thickness = 0.0015;
  box.size = {0.02, 0.006, 0.04};
  rake.radius = 0.0015;
  cylinder.radius = 0.003;
  const std::pair<ToolSettings, double> cases[] = {
      {plate, 0.0015}, {box, 0.006}, {rake, 0.003}, {cylinder, 0.006}, {shaped(ToolShape::sphere), 0.02}};
  for (const auto& [tool, width] : cases)
    for (const double turn : {0.0, 15.0, 45.0}) {
      ToolSettings turned_tool = tool;
      turned_tool.orientation.z() = turn;
      EXPECT_NEAR(narrowest_width(turned_tool, whole_tool), width, 1e-3 * width)
          << static_cast<int>(tool.shape);
      EXPECT_NEAR(narrowest_width(turned_tool, 0.004), width, 1e-3 * width) << static_cast<int>(tool.shape);
    }
}

TEST(ToolWidth, OfAConeGrowsWithItsDepth) {
  const ToolSettings cone = shaped(ToolShape::cone);  // 10 mm wide on each side at 40 mm
  EXPECT_NEAR(narrowest_width(cone, 0.004), 0.002, 2e-6);
  EXPECT_NEAR(narrowest_width(cone, 0.02), 0.01, 1e-5);
  EXPECT_NEAR(narrowest_width(cone, whole_tool), 0.02, 2e-5);
}

TEST(ToolWidth, OfALeaningPlateIsThatOfItsLevelCuts) {
  ToolSettings plate = shaped(ToolShape::plate);
  plate.orientation.y() = 60.0;
  EXPECT_NEAR(narrowest_width(plate, 0.02), 0.004 / std::cos(60.0 * std::numbers::pi / 180.0), 1e-8);
}

TEST(ToolWidth, OfACombIsThatOfItsTeethUnderAWideBeam) {
  // Two boxes side by side under a third, 2 mm apart in height: one file, three bodies.
  TriangleMesh comb;
  const auto add_box = [&](const Eigen::Vector3d& size, const Eigen::Vector3d& at) {
    ToolSettings box = shaped(ToolShape::box);
    box.size = size;
    const TriangleMesh part = tool_surface(box);
    const auto first = static_cast<std::int32_t>(comb.vertices.size());
    for (const Eigen::Vector3d& vertex : part.vertices) comb.vertices.push_back(vertex + at);
    for (const auto& t : part.triangles) comb.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  };
  add_box({0.02, 0.001, 0.01}, {0.0, -0.01, 0.0});
  add_box({0.02, 0.003, 0.01}, {0.0, 0.01, 0.0});
  add_box({0.02, 0.04, 0.01}, {0.0, 0.0, 0.012});
  EXPECT_NEAR(narrowest_width(comb, 0.005), 0.001, 1e-9);
  EXPECT_NEAR(narrowest_width(comb, whole_tool), 0.02, 1e-9);  // stirred up to its beam, it is that wide
}

TEST(ToolWidth, OfAThinTubeIsAtMostTwiceItsWall) {
  // The inner surface of a tube looks inwards: a cylinder in a cylinder, turned inside out.
  ToolSettings outer = shaped(ToolShape::cylinder), inner = outer;
  inner.radius = 0.009;
  TriangleMesh tube = tool_surface(outer);
  const TriangleMesh bore = tool_surface(inner);
  const auto first = static_cast<std::int32_t>(tube.vertices.size());
  tube.vertices.insert(tube.vertices.end(), bore.vertices.begin(), bore.vertices.end());
  for (const auto& t : bore.triangles) tube.triangles.push_back({first + t[0], first + t[2], first + t[1]});
  EXPECT_NEAR(narrowest_width(tube, 0.01), 0.002, 1e-6);
}

}  // namespace
}  // namespace sandstroke
