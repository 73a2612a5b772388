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
  const RowSpan span = row_span(cells);
  // Columns in whole groups: those with a flagged cell, one more on either side, and what their cells compare
  // with.
  const unsigned groups = groups_of(columns_of(cells));
  if (!groups) return;
  const int col_begin = std::max((std::countr_zero(groups) - 1) * cells_per_group - 1, -rim);
  const int col_end =
      std::min((static_cast<int>(std::bit_width(groups)) + 1) * cells_per_group + 1, side + rim);
  for (int part = -1; part <= 1; ++part) {  // the tile row above, the tile's own, the one below
    const int begin = std::max(span.begin - rim, part * side);
    const int end = std::min(span.end + rim, (part + 1) * side);
    if (begin >= end) continue;
    for (int col_part = -1; col_part <= 1; ++col_part) {
      const int first = std::max(col_begin - col_part * side, 0);
      const int last = std::min(col_end - col_part * side, side);
      if (first >= last) continue;
      const int beside = bed.tile_beside(bed.tile_of(slot), part, col_part);
      const int other = beside < 0 ? -1 : bed.slot_of(beside);
      const double* source = other < 0 ? nullptr : bed.tile_heights(other);
      const CellRange inside = other < 0 ? CellRange{} : bed.tile_cells(beside);
      for (int row = begin; row < end; ++row) {
        double* out = heights(row) + col_part * side;
        const int in_source = row - part * side;
        const int until = in_source < inside.rows() ? std::clamp(inside.cols(), first, last) : first;
        for (int col = first; col < until; ++col) out[col] = source[in_source * side + col];
        for (int col = until; col < last; ++col) out[col] = wall;
        if (first == until) continue;
        for (std::uint64_t held = bed.held_cells(other)[in_source] >> first; held; held &= held - 1) {
          const int col = first + std::countr_zero(held);
          if (col >= until) break;
          out[col] = wall;
        }
      }
    }
  }
}

}  // namespace sandstroke
