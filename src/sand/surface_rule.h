#pragma once

#include <cstddef>
#include <optional>

#include "sand/bed_geometry.h"

namespace sandstroke {

/// A rule for the height of every cell before anything touches it, so that untouched sand needs no memory.
class SurfaceRule {
 public:
  virtual ~SurfaceRule() = default;
  /// Heights [m] of `cells`, row after row, rows `stride` apart in `out`.
  virtual void fill(const BedGeometry& bed, const CellRange& cells, double* out,
                    std::ptrdiff_t stride) const = 0;
  /// An upper bound of the slope (rise over run) between cells of this range; 0 if all have the same height.
  virtual double steepest(const BedGeometry& bed, const CellRange& cells) const = 0;
  /// An upper bound of all heights [m].
  virtual double highest() const = 0;

  double height(const BedGeometry& bed, int row, int col) const {
    double height = 0.0;
    fill(bed, {row, row + 1, col, col + 1}, &height, 1);
    return height;
  }
  /// The common height [m] of all cells of this range; none if they differ.
  std::optional<double> level(const BedGeometry& bed, const CellRange& cells) const {
    if (steepest(bed, cells) != 0.0) return std::nullopt;
    return height(bed, cells.row_begin, cells.col_begin);
  }
};

/// All cells at one height [m].
class LevelRule : public SurfaceRule {
 public:
  explicit LevelRule(double height) : height_(height) {}
  void fill(const BedGeometry&, const CellRange& cells, double* out, std::ptrdiff_t stride) const override {
    for (int row = 0; row < cells.rows(); ++row, out += stride) std::fill(out, out + cells.cols(), height_);
  }
  double steepest(const BedGeometry&, const CellRange&) const override { return 0.0; }
  double highest() const override { return height_; }

 private:
  double height_;
};

/// Calls visit(tiles) for rectangles of tiles, given by tile rows and columns: first for all of them, then,
/// wherever `visit` returned true, for its quarters, down to single tiles.
template <class Visit>
void visit_quarters(const CellRange& tiles, const Visit& visit) {
  if (tiles.empty() || !visit(tiles) || (tiles.rows() == 1 && tiles.cols() == 1)) return;
  const int row = tiles.row_begin + (tiles.rows() + 1) / 2, col = tiles.col_begin + (tiles.cols() + 1) / 2;
  visit_quarters(CellRange{tiles.row_begin, row, tiles.col_begin, col}, visit);
  visit_quarters(CellRange{tiles.row_begin, row, col, tiles.col_end}, visit);
  visit_quarters(CellRange{row, tiles.row_end, tiles.col_begin, col}, visit);
  visit_quarters(CellRange{row, tiles.row_end, col, tiles.col_end}, visit);
}

}  // namespace sandstroke
