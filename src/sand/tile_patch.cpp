#include "sand/tile_patch.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace sandstroke {

TilePatch::TilePatch() {
  heights_.fill(std::numeric_limits<double>::quiet_NaN());
  factors_.fill(0.0);
}

TilePatch& TilePatch::of_this_thread() {
  thread_local TilePatch patch;
  return patch;
}

void TilePatch::load(const HeightField& bed, int slot, const CellFlags& cells) {
  constexpr double wall = std::numeric_limits<double>::quiet_NaN();
  const int tile = bed.tile_of(slot), tile_row = tile / bed.tile_cols(), tile_col = tile % bed.tile_cols();
  const RowSpan span = row_span(cells);
  // Columns in groups of 8: those with a flagged cell, one more on either side, and what their cells compare
  // with.
  std::uint64_t all = 0;
  for (int row = span.begin; row < span.end; ++row) all |= cells[row];
  const unsigned groups = groups_of(all);
  if (!groups) return;
  const int col_begin = std::max((std::countr_zero(groups) - 1) * margin - 1, -rim);
  const int col_end = std::min((static_cast<int>(std::bit_width(groups)) + 1) * margin + 1, side + rim);
  for (int part = -1; part <= 1; ++part) {  // the tile row above, the tile's own, the one below
    const int begin = std::max(span.begin - rim, part * side);
    const int end = std::min(span.end + rim, (part + 1) * side);
    if (begin >= end) continue;
    for (int col_part = -1; col_part <= 1; ++col_part) {
      const int first = std::max(col_begin - col_part * side, 0);
      const int last = std::min(col_end - col_part * side, side);
      if (first >= last) continue;
      const int r = tile_row + part, c = tile_col + col_part;
      const bool inside = r >= 0 && r < bed.tile_rows() && c >= 0 && c < bed.tile_cols();
      const int other = !inside ? -1 : part == 0 && col_part == 0 ? slot : bed.slot_of(bed.tile_index(r, c));
      const double* source = other < 0 ? nullptr : bed.tile_heights(other);
      const int cols = other < 0 ? first : std::clamp(bed.cols() - c * side, first, last);  // inside the bed
      const int rows_inside = other < 0 ? 0 : bed.rows() - r * side;
      for (int row = begin; row < end; ++row) {
        double* out = heights(row) + col_part * side;
        const int in_source = row - part * side;
        const int until = in_source < rows_inside ? cols : first;
        for (int col = first; col < until; ++col) out[col] = source[in_source * side + col];
        for (int col = until; col < last; ++col) out[col] = wall;
      }
    }
  }
}

}  // namespace sandstroke
