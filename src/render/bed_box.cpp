#include "render/bed_box.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace sandstroke {
namespace {

struct Vertex {
  Eigen::Vector3f position, normal;
};

/// A line around the bed at one height [m], on each side `out` [m] away from the outermost cells.
struct Frame {
  double out, height;
};

/// The band between two such lines, as triangles.
void add_band(std::vector<Vertex>& vertices, const Eigen::Vector2d& half_bed, const Frame& from,
              const Frame& to) {
  constexpr std::array<std::array<double, 2>, 4> corners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const auto corner = [&](const Frame& frame, int i) {
    return Eigen::Vector3d(corners[i][0] * (half_bed.x() + frame.out),
                           corners[i][1] * (half_bed.y() + frame.out), frame.height);
  };
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    const Eigen::Vector3d a = corner(from, i), b = corner(from, next), c = corner(to, next),
                          d = corner(to, i);
    const Eigen::Vector3f normal = (b - a).cross(d - a).normalized().cast<float>();
    for (const Eigen::Vector3d& position : {a, b, c, a, c, d})
      vertices.push_back({position.cast<float>(), normal});
  }
}

}  // namespace

BedBox::BedBox() : layout_(make_vertex_array()), vertices_(make_buffer()) {
  glBindVertexArray(layout_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                        reinterpret_cast<const void*>(offsetof(Vertex, normal)));
}

void BedBox::update(const BedGeometry& bed, const StartHeights& start) {
  const Eigen::Vector2d half_bed(bed.x_of(bed.cols() - 1), bed.y_of(bed.rows() - 1));
  const double side = 2.0 * half_bed.maxCoeff(), thickness = 0.012 * side;
  const double rim = start.border + 0.15 * thickness, ground = start.lowest - 3.0 * thickness;
  // On the inside, the wall also lines pits below the ground.
  const Frame bottom{0.0, ground - side}, inner{0.0, rim}, outer{thickness, rim}, foot{thickness, ground};
  const Frame horizon{20.0 * side, ground};

  std::vector<Vertex> vertices;
  add_band(vertices, half_bed, bottom, inner);
  add_band(vertices, half_bed, inner, outer);
  add_band(vertices, half_bed, outer, foot);
  wall_vertices_ = static_cast<int>(vertices.size());
  add_band(vertices, half_bed, foot, horizon);
  ground_vertices_ = static_cast<int>(vertices.size()) - wall_vertices_;

  const Eigen::Vector2d outside = half_bed.array() + thickness;
  bounds_ = {Eigen::Vector3d(-outside.x(), -outside.y(), ground),
             Eigen::Vector3d(outside.x(), outside.y(), rim)};
  wall_thickness_ = thickness;
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
               GL_STREAM_DRAW);
  check_gl("making the box");
}

void BedBox::draw_wall() const {
  glBindVertexArray(layout_);
  glDrawArrays(GL_TRIANGLES, 0, wall_vertices_);
}

void BedBox::draw_ground_depth() const {
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glEnable(GL_DEPTH_CLAMP);  // near the camera the ground is nearer than the range of depths
  glBindVertexArray(layout_);
  glDrawArrays(GL_TRIANGLES, wall_vertices_, ground_vertices_);
  glDisable(GL_DEPTH_CLAMP);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace sandstroke
