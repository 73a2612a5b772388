#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace sandstroke {

/// A bed seen as one block, height(row, col) in m; row-major, as files and pictures take it.
using HeightGrid = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A half-open rectangle of cells: row_begin <= row < row_end, likewise col.
struct CellRange {
  int row_begin = 0, row_end = 0, col_begin = 0, col_end = 0;
  bool empty() const { return row_begin >= row_end || col_begin >= col_end; }
};

/// Rows x cols mean cell heights [m] over a rectangle centred on the origin. x grows with col, y with row.
/// Cells are kept in square tiles: the unit in which sand is relaxed, written and drawn, each with a revision
/// that changes when one of its cells does.
class HeightField {
 public:
  static constexpr int tile_side = 64;  ///< cells

  /// A flat bed at z = 0. cell_size [m] > 0.
  HeightField(int rows, int cols, double cell_size);
  HeightField(const HeightGrid& heights, double cell_size);

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  double cell_size() const { return cell_size_; }
  double cell_area() const { return cell_size_ * cell_size_; }

  double operator()(int row, int col) const { return cells_[index(row, col)]; }
  /// Sets one cell and marks its tile as changed.
  void set(int row, int col, double height) {
    cells_[index(row, col)] = height;
    ++revisions_[tile_index(row / tile_side, col / tile_side)];
  }

  /// Centre of a cell [m]; row_at and col_at are the inverse, as real numbers: row_at(y_of(r)) == r.
  double x_of(int col) const { return (col - col_origin_) * cell_size_; }
  double y_of(int row) const { return (row - row_origin_) * cell_size_; }
  double col_at(double x) const { return x / cell_size_ + col_origin_; }
  double row_at(double y) const { return y / cell_size_ + row_origin_; }

  // --- tiles: tile (i, j) holds rows [i * tile_side, ...) and cols [j * tile_side, ...) ---
  int tile_rows() const { return tile_rows_; }
  int tile_cols() const { return tile_cols_; }
  int tile_count() const { return tile_rows_ * tile_cols_; }
  int tile_index(int tile_row, int tile_col) const { return tile_row * tile_cols_ + tile_col; }
  /// The cells of a tile that lie inside the bed.
  CellRange tile_cells(int tile) const;
  /// tile_side x tile_side heights, row-major; those outside the bed are unused.
  const double* tile_data(int tile) const {
    return cells_.data() + static_cast<std::size_t>(tile) * tile_area;
  }
  /// Exchanges a tile's heights with `heights` (tile_area of them) and marks it as changed.
  void swap_tile(int tile, std::vector<double>& heights);
  /// Changes whenever a cell of the tile may have changed.
  std::uint64_t tile_revision(int tile) const { return revisions_[tile]; }

  HeightGrid grid() const;

  /// sum(h) dx^2 [m^3], compensated, in fixed order.
  double volume() const;

  static constexpr int tile_area = tile_side * tile_side;

 private:
  std::size_t index(int row, int col) const {
    const auto r = static_cast<unsigned>(row), c = static_cast<unsigned>(col);
    const std::size_t tile = (r / tile_side) * static_cast<std::size_t>(tile_cols_) + c / tile_side;
    return tile * tile_area + (r % tile_side) * tile_side + c % tile_side;
  }

  int rows_, cols_;
  double cell_size_;
  double row_origin_, col_origin_;  // the bed's centre in cell indices, (n - 1) / 2
  int tile_rows_, tile_cols_;
  std::vector<double> cells_;  // tile after tile
  std::vector<std::uint64_t> revisions_;
};

}  // namespace sandstroke
