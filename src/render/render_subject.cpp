#include "render/render_subject.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sandstroke {

Eigen::AlignedBox3d ToolBody::box() const {
  Eigen::AlignedBox3d box(centre().array() - radius, centre().array() + radius);
  if (!mesh) return box;
  box.setEmpty();
  for (const Eigen::Vector3d& vertex : mesh->vertices) box.extend(tip + vertex);
  if (load)
    for (const Eigen::Vector3d& vertex : load->vertices) box.extend(tip + vertex);
  return box;
}

CellRange framed_cells(const CellRange& focus, int rows, int cols, double cell_size, double margin) {
  if (focus.empty()) return {0, rows, 0, cols};
  const int larger = std::max(focus.rows(), focus.cols());
  const int grow = static_cast<int>(std::ceil(std::max(0.05 * larger, margin / cell_size)));
  return {std::max(0, focus.row_begin - grow), std::min(rows, focus.row_end + grow),
          std::max(0, focus.col_begin - grow), std::min(cols, focus.col_end + grow)};
}

StartHeights start_heights(const HeightField& surface) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  StartHeights found{infinite, -infinite, -infinite};
  const auto take = [&](int row, int col, double height) {
    found.lowest = std::min(found.lowest, height);
    found.highest = std::max(found.highest, height);
    if (row == 0 || row == surface.rows() - 1 || col == 0 || col == surface.cols() - 1)
      found.border = std::max(found.border, height);
  };
  std::vector<double> heights(HeightField::tile_area);
  for (int tile = 0; tile < surface.tile_count(); ++tile) {
    const CellRange cells = surface.tile_cells(tile);
    if (surface.slot_of(tile) < 0) {
      if (const std::optional<double> level = surface.untouched().level(surface, cells)) {
        take(cells.row_begin, cells.col_begin, *level);
        take(cells.row_end - 1, cells.col_end - 1, *level);
        continue;
      }
    }
    surface.read_tile(tile, heights.data());
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col)
        take(cells.row_begin + row, cells.col_begin + col, heights[row * HeightField::tile_side + col]);
  }
  return found;
}

CellRange cells_under(const std::vector<Eigen::Vector3d>& tips, double radius, const BedGeometry& bed,
                      double highest) {
  Eigen::AlignedBox2d under;
  for (const Eigen::Vector3d& tip : tips)
    if (tip.allFinite() && tip.z() < highest) under.extend(tip.head<2>());
  if (under.isEmpty()) return {};
  const auto cell = [](double at, int count) {
    return static_cast<int>(std::clamp(at, -1.0, static_cast<double>(count)));
  };
  const Eigen::Vector2d low = under.min().array() - radius, high = under.max().array() + radius;
  const CellRange range{std::max(0, cell(std::ceil(bed.row_at(low.y())), bed.rows())),
                        std::min(bed.rows(), cell(std::floor(bed.row_at(high.y())), bed.rows()) + 1),
                        std::max(0, cell(std::ceil(bed.col_at(low.x())), bed.cols())),
                        std::min(bed.cols(), cell(std::floor(bed.col_at(high.x())), bed.cols()) + 1)};
  return range.empty() ? CellRange{} : range;
}

Eigen::AlignedBox3d box_over(const BedGeometry& bed, const CellRange& cells, double lowest, double highest) {
  return {Eigen::Vector3d(bed.x_of(cells.col_begin), bed.y_of(cells.row_begin), lowest),
          Eigen::Vector3d(bed.x_of(cells.col_end - 1), bed.y_of(cells.row_end - 1), highest)};
}

ValueRange value_range(double least, double greatest, ColourScale scale) {
  if (scale == ColourScale::diverging) {
    const double most = std::max(std::abs(least), std::abs(greatest));
    return most > 0.0 ? ValueRange{-most, most} : ValueRange{-5e-4, 5e-4};
  }
  return greatest > least ? ValueRange{least, greatest} : ValueRange{least - 5e-4, least + 5e-4};
}

}  // namespace sandstroke
