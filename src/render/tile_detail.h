#pragma once

#include <array>

#include "render/horizon.h"

namespace sandstroke {

/// A tile is drawn at level 0 (every cell) to coarsest_level (one square), each level with every second row
/// and column of the one before.
inline constexpr int coarsest_level = 6;
static_assert(HeightField::tile_side == 1 << coarsest_level);

/// What decides how finely a tile must be drawn. A tile's patch of surface reaches to the first row and
/// column of the tiles after it.
struct TileDetail {
  double lowest = 0.0, highest = 0.0;              ///< m, over the patch
  double steepest = 0.0;                           ///< m per cell, of the triangles at level 0
  std::array<double, coarsest_level + 1> error{};  ///< m, largest height error at each level; grows with it
};

/// `patch`: the cells of the tile and of the next row and column, where there are any.
TileDetail tile_detail(const DrawnHeights& heights, const CellRange& patch);

/// Down to here a tile has a skirt, [m]: a cell below the lowest, for between flat tiles, too, rounding
/// leaves gaps of a sample here and there.
double skirt_bottom(const TileDetail& detail, double cell_size);

/// The coarsest level at which triangles are at most 2 pixels long, or wrong by at most a third of a pixel.
int level_of_detail(const TileDetail& detail, double cell_size, double pixels_per_metre);

}  // namespace sandstroke
