#include "sand/ground_patch.h"

#include <limits>

namespace sandstroke {

void GroundPatch::load(const std::shared_ptr<const Ground>& ground, int tile, bool near_level) {
  if (ground == ground_ && tile == tile_ && near_level == near_level_) return;
  ground_ = ground;
  tile_ = tile;
  near_level_ = near_level;
  has_floor = near_level || ground->has_floor_around(tile);
  constexpr int rim = PatchLayout::rim, side = PatchLayout::side;
  const CellRange cells = ground->floor.tile_cells(tile);
  const double cell_size = ground->floor.cell_size(), level = ground->level(),
               none = -std::numeric_limits<double>::infinity();
  only_drop = ground->talus_slopes.untouched().highest() * cell_size;
  is_even = !ground->has_slopes_around(tile);
  const auto take_floor = [&](double there) { return there == level && !near_level ? none : there; };
  const int floor_slot = ground->floor.slot_of(tile);
  for (int row = -rim; row < side + rim; ++row) {
    const int r = cells.row_begin + row;
    double *T = axis_drops.row(row), *s = floor.row(row);
    for (int col = -rim; col < side + rim; ++col) {
      const int c = cells.col_begin + col;
      if (r < 0 || r >= ground->floor.rows() || c < 0 || c >= ground->floor.cols()) {
        T[col] = s[col] = std::numeric_limits<double>::quiet_NaN();
        continue;
      }
      T[col] = is_even ? only_drop : ground->talus_slopes(r, c) * cell_size;
      const bool own = floor_slot >= 0 && row >= 0 && row < side && col >= 0 && col < side;
      s[col] =
          take_floor(own ? ground->floor.tile_heights(floor_slot)[row * side + col] : ground->floor(r, c));
    }
  }
}

}  // namespace sandstroke
