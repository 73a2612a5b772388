#include "render/load_mesh.h"

#include <cmath>

namespace sandstroke {

TriangleMesh load_mesh(const LoadSurface& load) {
  const BedGeometry grid(static_cast<int>(load.height.rows()), static_cast<int>(load.height.cols()),
                         load.cell_size);
  const Eigen::Vector2d across(-load.along.y(), load.along.x());
  TriangleMesh mesh;
  Eigen::ArrayXXi vertices = Eigen::ArrayXXi::Constant(grid.rows(), grid.cols(), -1);
  for (int row = 0; row < grid.rows(); ++row)
    for (int col = 0; col < grid.cols(); ++col) {
      const double height = load.height(row, col);
      if (std::isnan(height)) continue;
      vertices(row, col) = static_cast<int>(mesh.vertices.size());
      const Eigen::Vector2d place = grid.x_of(col) * load.along + grid.y_of(row) * across;
      mesh.vertices.emplace_back(place.x(), place.y(), height);
    }
  const auto add = [&](int a, int b, int c) {
    if (a >= 0 && b >= 0 && c >= 0) mesh.triangles.push_back({a, b, c});
  };
  for (int row = 0; row + 1 < grid.rows(); ++row)
    for (int col = 0; col + 1 < grid.cols(); ++col) {
      const int a = vertices(row, col), b = vertices(row, col + 1), c = vertices(row + 1, col + 1),
                d = vertices(row + 1, col);
      if (b >= 0 && d >= 0) {  // three corners make one
        add(a, b, d);
        add(b, c, d);
      } else {
        add(a, b, c);
        add(a, c, d);
      }
    }
  return mesh;
}

}  // namespace sandstroke
