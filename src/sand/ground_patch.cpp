#include "sand/ground_patch.h"

#include <algorithm>
#include <limits>

namespace sandstroke {
namespace {

constexpr int rim = PatchLayout::rim, side = PatchLayout::side;

/// Copies a row of the field, from the rim before this column to the one after its tile. NaN outside the bed.
void copy_row(const HeightField& field, int row, int first_col, double* out) {
  std::fill_n(out - rim, side + 2 * rim, std::numeric_limits<double>::quiet_NaN());
  if (row < 0 || row >= field.rows()) return;
  const int end = std::min(first_col + side + rim, field.cols());
  for (int col = std::max(first_col - rim, 0); col < end;) {
    const int tile = field.tile_index(row / side, col / side), slot = field.slot_of(tile),
              until = std::min(end, (col / side + 1) * side);
    if (slot >= 0)
      std::copy_n(field.tile_heights(slot) + row % side * side + col % side, until - col,
                  out + col - first_col);
    else
      for (int c = col; c < until; ++c) out[c - first_col] = field.untouched().height(field, row, c);
    col = until;
  }
}

}  // namespace

void GroundPatch::load(const std::shared_ptr<const Ground>& ground, int tile, bool near_level) {
  if (ground == ground_ && tile == tile_ && near_level == near_level_) return;
  ground_ = ground;
  tile_ = tile;
  near_level_ = near_level;
  has_floor = near_level || ground->has_floor_around(tile);
  const CellRange cells = ground->floor.tile_cells(tile);
  const double cell_size = ground->floor.cell_size(), level = ground->level(),
               none = -std::numeric_limits<double>::infinity();
  only_drop = ground->talus_slopes.untouched().highest() * cell_size;
  is_even = !ground->has_slopes_around(tile);
  for (int row = -rim; row < side + rim; ++row) {
    const int r = cells.row_begin + row;
    double *T = axis_drops.row(row), *s = floor.row(row);
    copy_row(ground->floor, r, cells.col_begin, s);
    if (!near_level) std::replace(s - rim, s + side + rim, level, none);
    if (is_even) {
      for (int col = -rim; col < side + rim; ++col) T[col] = s[col] == s[col] ? only_drop : s[col];
    } else {
      copy_row(ground->talus_slopes, r, cells.col_begin, T);
      for (int col = -rim; col < side + rim; ++col) T[col] *= cell_size;
    }
  }
}

}  // namespace sandstroke
