#include "render/bed_box.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace sandstroke {
namespace {

struct Vertex {
  Eigen::Vector3f place, normal;
};

/// A place on the bed's border: the sand there, and which way is out (a diagonal at a corner).
struct Station {
  Eigen::Vector2d place, out;
  double height;
};

/// Once around the bed, from the corner of row 0, column 0.
std::vector<Station> stations_along_border(const BedGeometry& bed, const DrawnHeights& heights) {
  const int rows = bed.rows(), cols = bed.cols();
  std::vector<Station> stations;
  const auto add = [&](int row, int col) {
    const auto side = [](int i, int count) { return i == 0 ? -1.0 : i == count - 1 ? 1.0 : 0.0; };
    stations.push_back({{bed.x_of(col), bed.y_of(row)},
                        {side(col, cols), side(row, rows)},
                        static_cast<double>(heights(row, col))});
  };
  for (int col = 0; col < cols - 1; ++col) add(0, col);
  for (int row = 0; row < rows - 1; ++row) add(row, cols - 1);
  for (int col = cols - 1; col > 0; --col) add(rows - 1, col);
  for (int row = rows - 1; row > 0; --row) add(row, 0);
  return stations;
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

void BedBox::update(const BedGeometry& bed, const DrawnHeights& heights, double lowest) {
  const double cell_size = bed.cell_size();
  const double thickness = 0.012 * std::max((bed.cols() - 1) * cell_size, (bed.rows() - 1) * cell_size);
  const double ground = lowest - 3.0 * thickness;
  const std::vector<Station> stations = stations_along_border(bed, heights);
  const auto count = static_cast<int>(stations.size());

  // The rim: the highest sand within a wall's thickness along the border, and a little more.
  const int reach = std::max(1, static_cast<int>(thickness / cell_size));
  std::vector<double> rim(stations.size());
  for (int i = 0; i < count; ++i) {
    rim[i] = stations[i].height;
    for (int k = -reach; k <= reach; ++k)
      rim[i] = std::max(rim[i], stations[(i + k + count * reach) % count].height);
    rim[i] += 0.15 * thickness;
  }

  // Inner face, rim and outer face, as triangles; ends where it began.
  std::vector<Vertex> vertices;
  bounds_.setEmpty();
  const auto corners = [&](int i) {
    const Station& s = stations[i];
    const Eigen::Vector2d outer = s.place + thickness * s.out;
    std::array<Eigen::Vector3d, 4> points = {
        Eigen::Vector3d(s.place.x(), s.place.y(), ground), Eigen::Vector3d(s.place.x(), s.place.y(), rim[i]),
        Eigen::Vector3d(outer.x(), outer.y(), rim[i]), Eigen::Vector3d(outer.x(), outer.y(), ground)};
    return points;
  };
  for (int i = 0; i < count; ++i) {
    const auto here = corners(i), next = corners((i + 1) % count);
    for (int face = 0; face < 3; ++face) {
      const Eigen::Vector3f normal =
          (next[face] - here[face]).cross(here[face + 1] - here[face]).normalized().cast<float>();
      for (const Eigen::Vector3d& p :
           {here[face], next[face], next[face + 1], here[face], next[face + 1], here[face + 1]}) {
        vertices.push_back({p.cast<float>(), normal});
        bounds_.extend(p);
      }
    }
  }
  wall_thickness_ = thickness;
  vertex_count_ = static_cast<int>(vertices.size());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
               GL_STREAM_DRAW);
  check_gl("making the box");
}

void BedBox::draw() const {
  glBindVertexArray(layout_);
  glDrawArrays(GL_TRIANGLES, 0, vertex_count_);
}

}  // namespace sandstroke
