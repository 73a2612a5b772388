#include "render/sphere_mesh.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace sandstroke {

SphereMesh::SphereMesh() : layout_(make_vertex_array()), vertices_(make_buffer()) {
  constexpr int meridians = 96, parallels = 48;
  using std::numbers::pi;
  const auto point = [&](int i, int j) {
    const double around = 2.0 * pi * (i % meridians) / meridians, down = pi * j / parallels;
    return Eigen::Vector3d(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around),
                           std::cos(down));
  };
  std::vector<Eigen::Vector3f> vertices;
  for (int j = 0; j < parallels; ++j)
    for (int i = 0; i < meridians; ++i)
      for (const auto& [di, dj] : {std::pair{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}})
        vertices.push_back(point(i + di, j + dj).cast<float>());
  vertex_count_ = static_cast<int>(vertices.size());
  glBindVertexArray(layout_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Eigen::Vector3f)),
               vertices.data(), GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Eigen::Vector3f), nullptr);
  check_gl("making the tool");
}

void SphereMesh::draw() const {
  glBindVertexArray(layout_);
  glDrawArrays(GL_TRIANGLES, 0, vertex_count_);
}

}  // namespace sandstroke
