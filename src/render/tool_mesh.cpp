#include "render/tool_mesh.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace sandstroke {
namespace {

std::vector<Eigen::Vector3f> sphere_corners() {
  constexpr int meridians = 96, parallels = 48;
  using std::numbers::pi;
  const auto point = [&](int i, int j) {
    const double around = 2.0 * pi * (i % meridians) / meridians, down = pi * j / parallels;
    return Eigen::Vector3d(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around),
                           std::cos(down));
  };
  std::vector<Eigen::Vector3f> corners;
  for (int j = 0; j < parallels; ++j)
    for (int i = 0; i < meridians; ++i)
      for (const auto& [di, dj] : {std::pair{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}})
        corners.push_back(point(i + di, j + dj).cast<float>());
  return corners;
}

std::vector<Eigen::Vector3f> corners_of(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> corners;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int which = 0; which < 3; ++which) corners.push_back(mesh.corner(i, which).cast<float>());
  return corners;
}

}  // namespace

ToolMesh::ToolMesh() : layout_(make_vertex_array()), vertices_(make_buffer()) { fill(sphere_corners()); }

void ToolMesh::show(const std::shared_ptr<const TriangleMesh>& mesh) {
  if (mesh == shown_) return;
  fill(mesh ? corners_of(*mesh) : sphere_corners());
  shown_ = mesh;
}

void ToolMesh::fill(const std::vector<Eigen::Vector3f>& corners) {
  vertex_count_ = static_cast<int>(corners.size());
  glBindVertexArray(layout_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(Eigen::Vector3f)),
               corners.data(), GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Eigen::Vector3f), nullptr);
  check_gl("making the tool");
}

void ToolMesh::draw() const {
  glBindVertexArray(layout_);
  glDrawArrays(GL_TRIANGLES, 0, vertex_count_);
}

}  // namespace sandstroke
