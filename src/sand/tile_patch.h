#pragma once

#include <array>

#include "sand/cell_flags.h"
#include "sand/height_field.h"

namespace sandstroke {

/// A tile's heights with a rim of two cells around them, as a relaxation pass reads them, and the pass's
/// scratch. Row r of the tile (-2 ... tile_side + 1) begins with column 0 on a 64-byte boundary.
class TilePatch {
 public:
  static constexpr int side = BedGeometry::tile_side;
  static constexpr int rim = 2;  ///< inflow comes from one cell away, whose share depends on one cell further
  static constexpr int margin = 8;  ///< doubles before column 0 and after the last: a group each
  static constexpr int stride = side + 2 * margin;

  TilePatch();
  /// Each thread has one, so that its memory is made once and shared with nobody.
  static TilePatch& of_this_thread();

  /// Loads the rows that the flagged cells' next heights depend on. field(slot): a tile's heights; the tiles
  /// around that the flagged cells see must exist. Outside the bed, and where no tile exists, cells are NaN:
  /// every comparison with them is false.
  template <class Field>
  void load(const HeightField& bed, int slot, const CellFlags& cells, const Field& field);

  double* heights(int row) { return heights_.data() + start(row); }
  const double* heights(int row) const { return heights_.data() + start(row); }
  /// The part of each drop that a cell gives away.
  double* factors(int row) { return factors_.data() + start(row); }
  const double* factors(int row) const { return factors_.data() + start(row); }

 private:
  static constexpr int rows = side + 2 * rim;
  static constexpr int size = rows * stride + 2 * margin;  // vectors reach a double beyond the margins
  static int start(int row) { return margin + (row + rim) * stride + margin; }

  alignas(64) std::array<double, size> heights_;
  alignas(64) std::array<double, size> factors_;
};

template <class Field>
void TilePatch::load(const HeightField& bed, int slot, const CellFlags& cells, const Field& field) {
  constexpr double wall = std::numeric_limits<double>::quiet_NaN();
  const int tile = bed.tile_of(slot), tile_row = tile / bed.tile_cols(), tile_col = tile % bed.tile_cols();
  const RowSpan span = row_span(cells);
  for (int part = -1; part <= 1; ++part) {  // the tile row above, the tile's own, the one below
    const int begin = std::max(span.begin - rim, part * side),
              end = std::min(span.end + rim, (part + 1) * side);
    if (begin >= end) continue;
    for (int col_part = -1; col_part <= 1; ++col_part) {
      const int r = tile_row + part, c = tile_col + col_part;
      const bool inside = r >= 0 && r < bed.tile_rows() && c >= 0 && c < bed.tile_cols();
      const int other = !inside ? -1 : part == 0 && col_part == 0 ? slot : bed.slot_of(bed.tile_index(r, c));
      const double* source = other < 0 ? nullptr : field(other);
      const int first = col_part < 0 ? side - rim : 0, last = col_part > 0 ? rim : side;
      const int cols =
          other < 0 ? 0 : std::clamp(bed.cols() - c * side, first, last);  // columns inside the bed end
      const int rows_inside = other < 0 ? 0 : bed.rows() - r * side;
      for (int row = begin; row < end; ++row) {
        double* out = heights(row) + col_part * side;
        const int in_source = row - part * side;
        const int until = in_source < rows_inside ? std::max(cols, first) : first;
        for (int col = first; col < until; ++col) out[col] = source[in_source * side + col];
        for (int col = until; col < last; ++col) out[col] = wall;
      }
    }
  }
}

}  // namespace sandstroke
