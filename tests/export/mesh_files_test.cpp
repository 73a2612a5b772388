#include "export/mesh_files.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <sstream>
#include <vector>

namespace sandstroke {
namespace {

using Corners = std::array<Eigen::Vector3f, 3>;

HeightGrid mesh_heights() {
  HeightGrid heights(2, 3);
  heights << 0.001, 0.0025, -0.004, 0.0, 0.01, 0.0333;
  return heights;
}

std::string written(const MeshFormat& format, const BedMesh& mesh) {
  std::ostringstream file;
  EXPECT_TRUE(format.write(file, mesh));
  EXPECT_TRUE(file.str().starts_with(format.kind.begin));
  EXPECT_NE(file.str().find(format.kind.mark), std::string::npos);
  EXPECT_GT(1.3 * format.bytes(mesh.size()) + 100.0, static_cast<double>(file.str().size()));
  return file.str();
}

template <class Value>
Value take(const std::string& bytes, std::size_t& at) {
  Value value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  at += sizeof value;
  return value;
}
Eigen::Vector3f take_vector(const std::string& bytes, std::size_t& at) {
  const float x = take<float>(bytes, at), y = take<float>(bytes, at), z = take<float>(bytes, at);
  return {x, y, z};
}

/// The mesh that the files must hold, in mm.
std::vector<Corners> corners_of(const BedMesh& mesh) {
  std::vector<Corners> all;
  mesh.visit_triangles([&](const BedMesh::Triangle& t) {
    Corners corners;
    for (int i = 0; i < 3; ++i) corners[i] = (1000.0 * mesh.vertex(t[i])).cast<float>();
    all.push_back(corners);
  });
  return all;
}

TEST(MeshFiles, AnStlHoldsTheTrianglesInMmWithTheirNormals) {
  const HeightGrid heights = mesh_heights();
  const BedMesh mesh(heights, 0.01, 0.002);
  const std::string bytes = written(stl_format, mesh);
  ASSERT_EQ(bytes.size(), 84 + 50 * mesh.size().triangles);
  EXPECT_FALSE(bytes.starts_with("solid"));  // which would be text
  std::size_t at = 80;
  EXPECT_EQ(take<std::uint32_t>(bytes, at), mesh.size().triangles);
  for (const Corners& corners : corners_of(mesh)) {
    const Eigen::Vector3f normal = take_vector(bytes, at);
    EXPECT_NEAR(normal.norm(), 1.0f, 1e-6f);
    EXPECT_GT(normal.dot((corners[1] - corners[0]).cross(corners[2] - corners[0])), 0.0f);
    EXPECT_NEAR(normal.dot((corners[1] - corners[0]).normalized()), 0.0f, 1e-6f);
    EXPECT_NEAR(normal.dot((corners[2] - corners[0]).normalized()), 0.0f, 1e-6f);
    for (const Eigen::Vector3f& corner : corners) EXPECT_EQ(take_vector(bytes, at), corner);
    EXPECT_EQ(take<std::uint16_t>(bytes, at), 0);
  }
}

TEST(MeshFiles, APlyHoldsTheSame) {
  const HeightGrid heights = mesh_heights();
  const BedMesh mesh(heights, 0.01, 0.002);
  const std::string bytes = written(ply_format, mesh);
  std::size_t at = bytes.find("end_header\n") + 11;
  std::vector<Eigen::Vector3f> vertices;
  for (std::uint64_t i = 0; i < mesh.size().vertices; ++i) vertices.push_back(take_vector(bytes, at));
  for (const Corners& corners : corners_of(mesh)) {
    EXPECT_EQ(take<std::uint8_t>(bytes, at), 3);
    for (const Eigen::Vector3f& corner : corners)
      EXPECT_EQ(vertices.at(static_cast<std::size_t>(take<std::int32_t>(bytes, at))), corner);
  }
  EXPECT_EQ(at, bytes.size());
}

TEST(MeshFiles, AnObjHoldsTheSame) {
  const HeightGrid heights = mesh_heights();
  const BedMesh mesh(heights, 0.01, std::nullopt);
  std::istringstream lines(written(obj_format, mesh));
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Corners> triangles;
  for (std::string line, word; std::getline(lines, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      Eigen::Vector3f& vertex = vertices.emplace_back();
      words >> vertex.x() >> vertex.y() >> vertex.z();
    } else if (word == "f") {
      std::size_t a = 0, b = 0, c = 0;
      words >> a >> b >> c;
      triangles.push_back({vertices.at(a - 1), vertices.at(b - 1), vertices.at(c - 1)});
    }
    EXPECT_TRUE(words) << line;
  }
  EXPECT_EQ(triangles, corners_of(mesh));
}

}  // namespace
}  // namespace sandstroke
