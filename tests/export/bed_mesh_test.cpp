#include "export/bed_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bed_on_stones.h"

namespace sandstroke {
namespace {

constexpr double cell_size = 0.01, base = 0.004;

HeightGrid rough(int rows, int cols) {
  HeightGrid heights(rows, cols);
  std::uint32_t state = 7;
  for (double& height : heights.reshaped())
    height = 0.02 * ((state = state * 1664525u + 1013904223u) >> 8) / double(1 << 24) - 0.005;
  return heights;
}

/// The number of times that each directed edge occurs.
std::map<std::pair<std::uint64_t, std::uint64_t>, int> edges_of(const BedMesh& mesh) {
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> edges;
  mesh.visit_triangles([&](const BedMesh::Triangle& t) {
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  });
  return edges;
}

/// The volume by the divergence theorem [m^3].
double volume_of(const BedMesh& mesh) {
  double volume = 0.0;
  mesh.visit_triangles([&](const BedMesh::Triangle& t) {
    volume += mesh.vertex(t[0]).dot(mesh.vertex(t[1]).cross(mesh.vertex(t[2]))) / 6.0;
  });
  return volume;
}

TEST(BedMesh, IsClosedForABody) {
  for (const auto& [rows, cols] : {std::pair(1, 1), {1, 4}, {5, 2}, {7, 9}}) {
    const HeightGrid heights = rough(rows, cols);
    const BedMesh mesh(heights, cell_size, base);
    const auto edges = edges_of(mesh);
    std::set<std::uint64_t> vertices;
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);  // of the neighbour, the other way
      vertices.insert(edge.first);
    }
    EXPECT_EQ(edges.size(), 3 * mesh.size().triangles);
    EXPECT_EQ(vertices.size(), mesh.size().vertices);
    EXPECT_EQ(*vertices.rbegin() + 1, mesh.size().vertices);
    // Euler: a body without holes.
    EXPECT_EQ(vertices.size() + mesh.size().triangles - edges.size() / 2, 2u);
  }
}

TEST(BedMesh, HoldsTheSandAboveItsFloor) {
  const HeightGrid heights = rough(7, 9);
  const BedMesh mesh(heights, cell_size, base);
  // Inner cells count whole: six triangles meet at their vertices. Where a corner's square is parted in two,
  // its four heights count by a third and a sixth instead of a quarter each.
  const double corners = heights(0, 0) + heights(6, 8) - heights(0, 8) - heights(6, 0);
  const double sand = cell_size * cell_size * ((heights - heights.minCoeff() + base).sum() + corners / 12.0);
  EXPECT_NEAR(volume_of(mesh), sand, 1e-14);
}

TEST(BedMesh, IsABoxForAFlatBed) {
  const HeightGrid heights = HeightGrid::Constant(20, 30, 0.003);
  const BedMesh mesh(heights, cell_size, base);
  Eigen::AlignedBox3d box;
  for (std::uint64_t i = 0; i < mesh.size().vertices; ++i) box.extend(mesh.vertex(i));
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3d(-0.15, -0.1, 0.003 - base), 1e-12));
  EXPECT_TRUE(box.max().isApprox(Eigen::Vector3d(0.15, 0.1, 0.003), 1e-12));
  EXPECT_NEAR(volume_of(mesh), 0.3 * 0.2 * base, 1e-15);
}

TEST(BedMesh, FacesOutwards) {
  const HeightGrid heights = rough(4, 6);
  const BedMesh mesh(heights, cell_size, base);
  const double floor = heights.minCoeff() - base;
  mesh.visit_triangles([&](const BedMesh::Triangle& t) {
    const Eigen::Vector3d a = mesh.vertex(t[0]), b = mesh.vertex(t[1]), c = mesh.vertex(t[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a), middle = (a + b + c) / 3.0;
    EXPECT_GT(normal.norm(), 0.0);
    const bool wall = std::abs(normal.z()) < 1e-12 * normal.norm();
    if (wall)
      EXPECT_GT(normal.head<2>().dot(middle.head<2>()), 0.0);
    else
      EXPECT_EQ(normal.z() > 0.0, middle.z() > floor + 0.5 * base);
  });
}

TEST(BedMesh, HasASurfacesHeightsAtTheCentresOfCells) {
  const HeightGrid heights = rough(3, 5);
  const BedMesh mesh(heights, cell_size, std::nullopt);
  EXPECT_EQ(mesh.size().vertices, 5u * 7u);
  EXPECT_EQ(mesh.size().triangles, 2u * 4u * 6u);
  const HeightField bed(heights, cell_size);
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 5; ++col) {
      const Eigen::Vector3d at = mesh.vertex(static_cast<std::uint64_t>(row + 1) * 7 + col + 1);
      EXPECT_EQ(at.z(), heights(row, col));
      EXPECT_NEAR(at.x(), bed.x_of(col), 1e-15);
      EXPECT_NEAR(at.y(), bed.y_of(row), 1e-15);
    }
  EXPECT_TRUE(mesh.vertex(0).isApprox(Eigen::Vector3d(-0.025, -0.015, heights(0, 0)), 1e-12));
  // Open at its border only, all of it facing up.
  std::uint64_t open = 0;
  const auto edges = edges_of(mesh);
  for (const auto& [edge, count] : edges) open += edges.count({edge.second, edge.first}) == 0;
  EXPECT_EQ(open, 2u * (4 + 6));
}

TEST(BedMesh, CountsTheLargestBed) {
  const MeshSize surface = mesh_size(65536, 65536, false), body = mesh_size(65536, 65536, true);
  EXPECT_EQ(surface.vertices, 65538ull * 65538);
  EXPECT_EQ(surface.triangles, 2ull * 65537 * 65537);
  EXPECT_EQ(body.triangles - surface.triangles, 3ull * 4 * 65537);
}

TEST(BedMesh, ItsSurfaceIsThatOfSandAndBareStones) {
  const HeightField bed = sand_with_a_stone(60, 80, 0.002, 0.03, -0.01);
  const HeightGrid heights = bed.grid();
  const BedMesh mesh(heights, bed.cell_size(), std::nullopt);
  double most = 0.0;
  for (std::uint64_t i = 0; i < mesh.size().vertices; ++i) {
    const Eigen::Vector3d at = mesh.vertex(i);
    const double x = at.x(), y = at.y(), square = 0.03 * 0.03 - x * x - y * y;
    const double sphere = square > 0.0 ? std::max(0.0, -0.01 + std::sqrt(square)) : 0.0;
    EXPECT_NEAR(at.z(), sphere, 1e-12);
    most = std::max(most, at.z());
  }
  EXPECT_GT(most, 0.0199);
}

}  // namespace
}  // namespace sandstroke
