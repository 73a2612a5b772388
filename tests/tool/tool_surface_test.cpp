#include "tool/tool_surface.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "core/angle.h"

namespace sandstroke {
namespace {

using std::numbers::pi;

ToolSettings tool_of(ToolShape shape) {
  ToolSettings tool;
  tool.shape = shape;
  return tool;
}
const std::vector<ToolShape> formula_shapes = {ToolShape::sphere, ToolShape::cylinder, ToolShape::cone,
                                               ToolShape::box,    ToolShape::plate,    ToolShape::rake,
                                               ToolShape::shovel, ToolShape::bowl};

TEST(ToolSurface, IsClosedAndItsTrianglesGoRoundOneWay) {
  for (const ToolShape shape : formula_shapes) {
    std::map<std::pair<int, int>, int> edges;
    for (const auto& corners : tool_surface(tool_of(shape)).triangles)
      for (int i = 0; i < 3; ++i) ++edges[{corners[i], corners[(i + 1) % 3]}];
    for (const auto& [edge, times] : edges) {
      EXPECT_EQ(times, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
  }
}

TEST(ToolSurface, EnclosesTheVolumeOfItsShape) {
  const ToolSettings tool;
  const double R = tool.radius, H = tool.height, round = 3e-4;
  const auto volume = [](ToolShape shape) { return enclosed_volume(tool_surface(tool_of(shape))); };
  const auto expect = [&](ToolShape shape, double expected) {
    EXPECT_NEAR(volume(shape), expected, round * expected);
  };
  expect(ToolShape::sphere, 4.0 / 3.0 * pi * R * R * R);
  expect(ToolShape::cylinder, pi * R * R * H);
  expect(ToolShape::cone, pi * R * R * H / 3.0);
  EXPECT_NEAR(volume(ToolShape::box), tool.size.prod(), 1e-18);
  EXPECT_NEAR(volume(ToolShape::plate), tool.thickness * tool.width * H, 1e-18);
  const Eigen::Vector3d &S = tool.size,
                        room(S.x() - tool.thickness, S.y() - 2.0 * tool.thickness, S.z() - tool.thickness);
  EXPECT_NEAR(volume(ToolShape::shovel), S.prod() - room.prod(), 1e-18);
  const double inner = R - tool.thickness;
  expect(ToolShape::bowl, pi * R * R * H - pi * inner * inner * (H - tool.thickness));
  const double tooth = 2.0 / 3.0 * pi * R * R * R + pi * R * R * (H - R);
  const double beam = 2.0 * R * (4.0 * tool.spacing + 2.0 * R) * 2.0 * R;
  EXPECT_NEAR(volume(ToolShape::rake), 5.0 * tooth + beam, round * 5.0 * tooth);
}

TEST(ToolSurface, StandsOnItsTip) {
  for (const ToolShape shape : formula_shapes) {
    double lowest = 1.0;
    for (const auto& vertex : tool_surface(tool_of(shape)).vertices) lowest = std::min(lowest, vertex.z());
    EXPECT_EQ(lowest, 0.0);
  }
}

TEST(ToolSurface, AQuarterTurnOfARoundToolIsTheSameSetOfCorners) {
  const Eigen::Matrix3d quarter =
      rotation_of(Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * pi, Eigen::Vector3d::UnitZ())));
  EXPECT_EQ(quarter, (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished());
  const auto less = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  for (const ToolShape shape : {ToolShape::sphere, ToolShape::cylinder, ToolShape::cone, ToolShape::bowl}) {
    TriangleMesh mesh = tool_surface(tool_of(shape)), other = turned(mesh, quarter);
    std::sort(mesh.vertices.begin(), mesh.vertices.end(), less);
    std::sort(other.vertices.begin(), other.vertices.end(), less);
    EXPECT_EQ(mesh.vertices, other.vertices);
  }
}

TEST(ToolSurface, IsTurnedAboutXThenYThenZ) {
  ToolSettings tool;
  tool.orientation = {90.0, 0.0, 0.0};
  EXPECT_EQ(own_rotation(tool) * Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ());
  tool.orientation = {90.0, 0.0, 90.0};  // y goes to z, which stays; x goes to y
  EXPECT_EQ(own_rotation(tool) * Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(own_rotation(tool) * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());
  tool.orientation = {0.0, 30.0, 0.0};  // about y: x sinks
  EXPECT_NEAR((own_rotation(tool) * Eigen::Vector3d::UnitX()).z(), -0.5, 1e-14);
}

}  // namespace
}  // namespace sandstroke
