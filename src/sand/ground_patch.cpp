#include "sand/ground_patch.h"

#include <algorithm>
#include <limits>

#include "sand/cell_ranges.h"

namespace sandstroke {
namespace {

/// Lays out the cells of a tile of a field and its rim. NaN outside the bed.
void read_around(const HeightField& field, const CellRange& tile, PatchHeights& out) {
  out.fill(std::numeric_limits<double>::quiet_NaN());
  const CellRange cells = common(grown(tile, PatchLayout::rim), {0, field.rows(), 0, field.cols()});
  field.read_cells(cells, out.row(cells.row_begin - tile.row_begin) + (cells.col_begin - tile.col_begin),
                   PatchLayout::stride);
}

}  // namespace

void GroundPatch::load(const std::shared_ptr<const Ground>& ground, int tile, bool near_level) {
  if (ground == ground_ && tile == tile_ && near_level == near_level_) return;
  ground_ = ground;
  tile_ = tile;
  near_level_ = near_level;
  has_floor = near_level || ground->has_floor_around(tile);
  constexpr int rim = PatchLayout::rim, side = PatchLayout::side;
  const CellRange cells = ground->floor.tile_cells(tile);
  const double cell_size = ground->floor.cell_size();
  only_drop = ground->talus_slopes.untouched().highest() * cell_size;
  is_even = !ground->has_slopes_around(tile);
  read_around(ground->floor, cells, floor);
  if (!is_even) read_around(ground->talus_slopes, cells, axis_drops);
  for (int row = -rim; row < side + rim; ++row) {
    double *T = axis_drops.row(row), *s = floor.row(row);
    for (int col = -rim; col < side + rim; ++col)
      T[col] = is_even ? (s[col] == s[col] ? only_drop : s[col]) : T[col] * cell_size;
    if (!near_level)
      std::replace(s - rim, s + side + rim, ground->level(), -std::numeric_limits<double>::infinity());
  }
}

}  // namespace sandstroke
