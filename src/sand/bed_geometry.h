#pragma once

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace sandstroke {

/// A half-open rectangle of cells: row_begin <= row < row_end, likewise col.
struct CellRange {
  int row_begin = 0, row_end = 0, col_begin = 0, col_end = 0;
  bool empty() const { return row_begin >= row_end || col_begin >= col_end; }
  int rows() const { return row_end - row_begin; }
  int cols() const { return col_end - col_begin; }
  bool operator==(const CellRange&) const = default;
};

/// The part of its rectangle that a bed fills: all of it, or the largest circle in it, as a sand table does.
enum class BedShape { rectangle, round };

/// Half-open: begin <= col < end.
struct ColumnRange {
  int begin = 0, end = 0;
};

/// Rows x cols square cells over a rectangle centred on the origin, x growing with col, y with row; and how
/// they are grouped into square tiles.
class BedGeometry {
 public:
  /// Side of a tile [cells]. With 64, the flags of a row are one machine word, and its heights eight AVX-512
  /// vectors.
  static constexpr int tile_side = 64;
  static constexpr int tile_area = tile_side * tile_side;
  static constexpr int most_cells = 65536;  ///< along a side

  /// cell_size [m] > 0.
  BedGeometry(int rows, int cols, double cell_size, BedShape shape = BedShape::rectangle)
      : rows_(rows),
        cols_(cols),
        cell_size_(cell_size),
        shape_(shape),
        row_origin_(0.5 * (rows - 1)),
        col_origin_(0.5 * (cols - 1)),
        tile_rows_((rows + tile_side - 1) / tile_side),
        tile_cols_((cols + tile_side - 1) / tile_side) {}

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  double cell_size() const { return cell_size_; }
  double cell_area() const { return cell_size_ * cell_size_; }
  CellRange cells() const { return {0, rows_, 0, cols_}; }
  BedShape shape() const { return shape_; }
  /// Radius of a round bed's wall [m].
  double wall_radius() const { return wall_radius_in_cells() * cell_size_; }
  /// The cells of a row that have sand: those whose centres lie within the shape. All others are wall.
  ColumnRange sand_cols(int row) const {
    if (shape_ == BedShape::rectangle) return {0, cols_};
    const double radius = wall_radius_in_cells(), y = rows_from_centre(row);
    if (std::abs(y) > radius) return {};
    const int begin = static_cast<int>(std::ceil(col_origin_ - std::sqrt(radius * radius - y * y)));
    return {begin, std::max(begin, cols_ - begin)};
  }
  bool has_sand(int row, int col) const {
    const ColumnRange sand = sand_cols(row);
    return col >= sand.begin && col < sand.end;
  }
  /// How far a position [m] lies beyond the bed's edge [m]; negative inside.
  double beyond_edge(double x, double y) const {
    if (shape_ == BedShape::round) return elementary::hypot(x, y) - wall_radius();
    return std::max(std::abs(x) - 0.5 * cols_ * cell_size_, std::abs(y) - 0.5 * rows_ * cell_size_);
  }
  /// Whether the other bed has as many rows and columns, and cells of the same size.
  bool same_grid(const BedGeometry& other) const {
    return rows_ == other.rows_ && cols_ == other.cols_ && cell_size_ == other.cell_size_;
  }

  /// Centre of a cell [m]; row_at and col_at are the inverse, as real numbers: row_at(y_of(r)) == r.
  double x_of(int col) const { return (col - col_origin_) * cell_size_; }
  double y_of(int row) const { return (row - row_origin_) * cell_size_; }
  double col_at(double x) const { return x / cell_size_ + col_origin_; }
  double row_at(double y) const { return y / cell_size_ + row_origin_; }

  /// The way from the bed's centre to a cell's [cells]: whole or half numbers, so exact.
  double cols_from_centre(int col) const { return col - col_origin_; }
  double rows_from_centre(int row) const { return row - row_origin_; }

  // Tile (i, j) holds rows [i * tile_side, ...) and cols [j * tile_side, ...).
  // Its index is i * tile_cols() + j.
  int tile_rows() const { return tile_rows_; }
  int tile_cols() const { return tile_cols_; }
  int tile_count() const { return tile_rows_ * tile_cols_; }
  int tile_index(int tile_row, int tile_col) const { return tile_row * tile_cols_ + tile_col; }
  /// The cells of a tile that lie inside the bed.
  CellRange tile_cells(int tile) const {
    const int row = tile / tile_cols_ * tile_side, col = tile % tile_cols_ * tile_side;
    return {row, std::min(row + tile_side, rows_), col, std::min(col + tile_side, cols_)};
  }
  /// The tile that lies row_step tile rows and col_step tile columns away; -1 outside the bed.
  int tile_beside(int tile, int row_step, int col_step) const {
    const int row = tile / tile_cols_ + row_step, col = tile % tile_cols_ + col_step;
    return row < 0 || row >= tile_rows_ || col < 0 || col >= tile_cols_ ? -1 : tile_index(row, col);
  }
  /// The cells of a rectangle of tiles, given by tile rows and columns.
  CellRange cells_of_tiles(const CellRange& tiles) const {
    return {tiles.row_begin * tile_side, std::min(tiles.row_end * tile_side, rows_),
            tiles.col_begin * tile_side, std::min(tiles.col_end * tile_side, cols_)};
  }

 private:
  double wall_radius_in_cells() const { return 0.5 * std::min(rows_, cols_); }

  int rows_, cols_;
  double cell_size_;
  BedShape shape_;
  double row_origin_, col_origin_;  // the bed's centre in cell indices, (n - 1) / 2
  int tile_rows_, tile_cols_;
};

}  // namespace sandstroke
