#pragma once

#include "rules/talus.h"
#include "sand/tile_patch.h"

namespace sandstroke {

/// Computes slope / tan(talus) - 1 of the steepest cell in each group of 8 that holds a flagged cell, from a
/// loaded patch. steepest: tile_area / 8 numbers, one per group; those of other groups are left alone.
void compute_residuals(const TalusLaw& law, const TilePatch& patch, const CellFlags& cells, double* steepest);

/// A number for each cell of a tile, row-major.
struct alignas(64) TileSlopes : std::array<double, BedGeometry::tile_area> {};
/// Computes slope / tan(talus) of all cells of a loaded patch, by isotropic or by faces (there, of the
/// steepest face through which a cell would give). 0 for walls.
void compute_slopes(const TalusLaw& law, const TilePatch& patch, TileSlopes& slopes);

}  // namespace sandstroke
