#include "export/bed_mesh.h"

#include <algorithm>

namespace sandstroke {

MeshSize mesh_size(int rows, int cols, bool body) {
  const std::uint64_t r = static_cast<std::uint64_t>(rows) + 1, c = static_cast<std::uint64_t>(cols) + 1;
  MeshSize size{(r + 1) * (c + 1), 2 * r * c};
  if (body) {
    size.vertices += 2 * (r + c) + 1;
    size.triangles += 3 * 2 * (r + c);
  }
  return size;
}

BedMesh::BedMesh(const HeightGrid& heights, double cell_size, std::optional<double> base)
    : heights_(heights),
      bed_(static_cast<int>(heights.rows()), static_cast<int>(heights.cols()), cell_size),
      rows_(static_cast<std::uint64_t>(heights.rows()) + 2),
      cols_(static_cast<std::uint64_t>(heights.cols()) + 2),
      size_(mesh_size(bed_.rows(), bed_.cols(), base.has_value())) {
  if (base) floor_ = heights.minCoeff() - *base;
}

Eigen::Vector3d BedMesh::vertex(std::uint64_t number) const {
  const std::uint64_t surface = rows_ * cols_;
  if (number < surface) return on_surface(number);
  if (number == surface + ring_size()) return {0.0, 0.0, *floor_};
  Eigen::Vector3d below = on_surface(on_ring(number - surface));
  below.z() = *floor_;
  return below;
}

Eigen::Vector3d BedMesh::on_surface(std::uint64_t number) const {
  // The coordinate of vertex i among n. Between the walls it is the centre of cell i - 1.
  const auto coordinate = [&](std::uint64_t i, std::uint64_t n, int& cell) {
    cell = std::clamp(static_cast<int>(i) - 1, 0, static_cast<int>(n) - 3);
    const double half = 0.5 * static_cast<double>(n - 2);
    const double cells = i == 0 ? -half : i == n - 1 ? half : cell - (half - 0.5);
    return cells * bed_.cell_size();
  };
  int row = 0, col = 0;
  const double x = coordinate(number % cols_, cols_, col), y = coordinate(number / cols_, rows_, row);
  return {x, y, heights_(row, col)};
}

std::uint64_t BedMesh::on_ring(std::uint64_t k) const {
  const std::uint64_t right = cols_ - 1, top = rows_ - 1;
  if (k < right) return k;
  k -= right;
  if (k < top) return k * cols_ + right;
  k -= top;
  if (k < right) return top * cols_ + (right - k);
  return (top - (k - right)) * cols_;
}

}  // namespace sandstroke
