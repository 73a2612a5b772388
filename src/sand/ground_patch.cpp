#include "sand/ground_patch.h"

#include <algorithm>
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
  const int row_end = std::min(cells.row_end + rim, ground->floor.rows()) - cells.row_begin,
            col_end = std::min(cells.col_end + rim, ground->floor.cols()) - cells.col_begin;
  const double cell_size = ground->floor.cell_size(), level = ground->level();
  for (int row = -rim; row < side + rim; ++row) {
    const bool in_rows = cells.row_begin + row >= 0 && row < row_end;
    for (int col = -rim; col < side + rim; ++col) {
      const bool inside = in_rows && cells.col_begin + col >= 0 && col < col_end;
      double T = std::numeric_limits<double>::quiet_NaN(), s = T;
      if (inside) {
        const int r = cells.row_begin + row, c = cells.col_begin + col;
        T = ground->talus_slopes(r, c) * cell_size;
        s = ground->floor(r, c);
        if (s == level && !near_level) s = -std::numeric_limits<double>::infinity();
      }
      axis_drops.row(row)[col] = T;
      floor.row(row)[col] = s;
    }
  }
}

}  // namespace sandstroke
