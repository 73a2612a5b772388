#pragma once

#include <array>

#include "render/horizon.h"

namespace sandstroke {

/// A tile is drawn at a level from 0 (every cell) to coarsest_level (one square). Each level has every second
/// row and column of the level before.
inline constexpr int coarsest_level = 6;
static_assert(HeightField::tile_side == 1 << coarsest_level);

/// Decides how finely a tile must be drawn. A tile's patch of surface reaches to the first row and column of
/// the next tiles.
struct TileDetail {
  double lowest = 0.0, highest = 0.0;              ///< m, over the patch
  double steepest = 0.0;                           ///< m per cell, of the triangles at level 0
  std::array<double, coarsest_level + 1> error{};  ///< m, largest height error at each level; grows with it
};

/// `patch`: the cells of the tile, and of the next row and column, where there are any.
TileDetail tile_detail(const DrawnHeights& heights, const CellRange& patch);

/// The lower end of a tile's skirt [m]. It is a cell below the lowest height, because rounding leaves gaps of
/// a sample here and there even between flat tiles.
double skirt_bottom(const TileDetail& detail, double cell_size);

/// The coarsest level at which triangles are at most 3 pixels long, or wrong by at most a third of a pixel.
int level_of_detail(const TileDetail& detail, double cell_size, double pixels_per_metre);

}  // namespace sandstroke
