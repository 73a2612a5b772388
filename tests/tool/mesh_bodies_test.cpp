#include "tool/mesh_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/error.h"
#include "tool/check_mesh.h"
#include "tool/mesh_overlap.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// A box [m], its lowest corner at `at`. Its 12 triangles have corners of their own.
TriangleMesh box_at(const Vector3d& at, const Vector3d& size) {
  ToolSettings settings;
  settings.shape = ToolShape::box;
  settings.size = size;
  TriangleMesh mesh = tool_surface(settings);
  for (Vector3d& vertex : mesh.vertices) vertex += at + Vector3d(0.5 * size.x(), 0.5 * size.y(), 0.0);
  return mesh;
}

TriangleMesh together(const std::vector<TriangleMesh>& parts) {
  TriangleMesh mesh;
  for (const TriangleMesh& part : parts) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& t : part.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return mesh;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& corners : mesh.triangles) std::swap(corners[0], corners[1]);
  return mesh;
}

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    area += 0.5 * (mesh.corner(i, 1) - mesh.corner(i, 0)).cross(mesh.corner(i, 2) - mesh.corner(i, 0)).norm();
  return area;
}

std::string complaint(const TriangleMesh& mesh) {
  try {
    checked_mesh(mesh, "t.stl");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const Vector3d block_at(-0.01, -0.01, 0.0), block_size(0.02, 0.02, 0.04);

TEST(MeshBodies, WhatIsThereTwiceOrInsideCountsOnce) {
  const TriangleMesh one = box_at(block_at, block_size),
                     inner = box_at({-0.005, -0.005, 0.01}, {0.01, 0.01, 0.01}),
                     innermost = box_at({-0.002, -0.002, 0.012}, {0.004, 0.004, 0.004});
  for (const TriangleMesh& mesh :
       {one, together({one, one}), together({one, one, one}), together({one, inner}), together({inner, one}),
        together({one, inside_out(inner)}), together({one, inner, innermost}),
        together({one, inside_out(inner), innermost}), together({inside_out(one), inside_out(one)}),
        together({one, inside_out(one)}), together({inside_out(one), one}),
        together({inner, one, inside_out(one)})}) {
    const TriangleMesh checked = checked_mesh(mesh, "t.stl");
    EXPECT_EQ(checked.vertices.size(), 8u);
    EXPECT_EQ(checked.triangles.size(), 12u);
    EXPECT_NEAR(enclosed_volume(checked), 1.6e-5, 1e-15);
    EXPECT_NEAR(area_of(checked), 0.004, 1e-12);
  }
}

TEST(MeshBodies, AFaceBetweenTwoPartsIsInside) {
  const TriangleMesh stacked =
      together({box_at(block_at, block_size), box_at({-0.01, -0.01, 0.04}, block_size)});
  const TriangleMesh checked = checked_mesh(stacked, "t.stl");
  EXPECT_EQ(checked.triangles.size(), 20u);
  EXPECT_NEAR(enclosed_volume(checked), 3.2e-5, 1e-15);
  EXPECT_NEAR(area_of(checked), 2 * 0.0004 + 4 * 0.02 * 0.08, 1e-12);
}

TEST(MeshBodies, SolidsThatOverlapOrTouchAreRefusedByName) {
  const TriangleMesh one = box_at(block_at, block_size);
  const Vector3d shifts[] = {{0.01, 0.003, 0.0},   {0.01, 0.0, 0.0},   {0.0, 0.0, 0.02}, {0.004, 0.004, 0.01},
                             {0.005, 0.005, 0.04}, {0.02, 0.01, 0.01}, {0.0, 0.01, 0.0}};
  for (const Vector3d& shift : shifts) {
    const std::string text = complaint(together({one, box_at(block_at + shift, block_size)}));
    EXPECT_NE(text.find("t.stl: two of its 2 bodies overlap or touch, those around (0, 0, 20) mm and ("),
              std::string::npos)
        << shift.transpose() << ": " << text;
  }
  EXPECT_NE(complaint(together({one, box_at(block_at + Vector3d(0.01, 0.003, 0.0), block_size)}))
                .find("(10, 3, 20) mm (their boxes share 10 x 17 x 40 mm)"),
            std::string::npos);
  // A bar through a block: no corner of either lies in the other.
  const TriangleMesh bar = box_at({-0.03, -0.002, 0.01}, {0.06, 0.004, 0.004});
  EXPECT_NE(complaint(together({one, bar})).find("bodies overlap"), std::string::npos);
}

TEST(MeshBodies, ABodyThatPassesThroughItselfIsRefused) {
  // Two boxes that overlap and share a corner hang together.
  TriangleMesh mesh = together({box_at(block_at, block_size), box_at(block_at, 0.5 * block_size)});
  EXPECT_NE(complaint(mesh).find("t.stl: the surface passes through itself near ("), std::string::npos)
      << complaint(mesh);
}

TEST(MeshBodies, BodiesApartAllCountAndAreTurnedEach) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> extent(0.002, 0.009);
  for (int round = 0; round < 20; ++round) {
    std::vector<TriangleMesh> parts;
    double volume = 0.0, area = 0.0;
    for (int i = 0; i < 4; ++i) {
      const Vector3d at(0.01 * (i % 2), 0.01 * (i / 2), 0.0),
          s(extent(random), extent(random), extent(random));
      volume += s.prod();
      area += 2.0 * (s.x() * s.y() + s.y() * s.z() + s.z() * s.x());
      parts.push_back(random() % 2 ? box_at(at, s) : inside_out(box_at(at, s)));
    }
    const TriangleMesh checked = checked_mesh(together(parts), "t.stl");
    EXPECT_EQ(checked.triangles.size(), 48u);
    EXPECT_NEAR(enclosed_volume(checked), volume, 1e-9 * volume);
    EXPECT_NEAR(area_of(checked), area, 1e-9 * area);
  }
}

TEST(MeshBodies, RandomBoxesAreRefusedWhereTwoOverlap) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.02, 0.02), extent(0.004, 0.02);
  int refused = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Eigen::AlignedBox3d> boxes;
    std::vector<TriangleMesh> parts;
    for (int i = 0; i < 3; ++i) {
      const Vector3d at(place(random), place(random), i == 0 ? 0.0 : 0.5 * place(random)),
          s(extent(random), extent(random), extent(random));
      boxes.emplace_back(at, at + s);
      parts.push_back(box_at(at, s));
    }
    // Surfaces meet where boxes do, unless one lies within the other.
    bool meet = false;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < i; ++j)
        meet |= boxes[i].intersects(boxes[j]) && !boxes[i].contains(boxes[j]) && !boxes[j].contains(boxes[i]);
    EXPECT_EQ(complaint(together(parts)).find("overlap or touch") != std::string::npos, meet) << round;
    refused += meet;
  }
  EXPECT_GT(refused, 20);
  EXPECT_LT(refused, 180);
}

TEST(MeshBodies, ManyBodiesAreRefused) {
  std::vector<TriangleMesh> parts;
  for (int i = 0; i < 1001; ++i)
    parts.push_back(box_at({1e-3 * (i % 40), 1e-3 * (i / 40), 0.0}, {5e-4, 5e-4, 5e-4}));
  EXPECT_NE(complaint(together(parts)).find("1001 bodies that do not hang together"), std::string::npos);
}

TEST(MeshBodies, SurfacesOfOnePieceDoNotOverlap) {
  for (const ToolShape shape :
       {ToolShape::sphere, ToolShape::cylinder, ToolShape::cone, ToolShape::box, ToolShape::plate}) {
    ToolSettings settings;
    settings.shape = shape;
    for (const double turn : {0.0, 17.0}) {
      settings.orientation = {turn, 2.0 * turn, turn};
      const TriangleMesh mesh = turned(tool_surface(settings), own_rotation(settings));
      EXPECT_FALSE(overlapping_triangles(mesh, 1e-8)) << static_cast<int>(shape);
    }
  }
}

}  // namespace
}  // namespace sandstroke
