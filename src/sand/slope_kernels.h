#pragma once

#include "rules/talus.h"
#include "sand/ground_patch.h"

namespace sandstroke {

/// Computes slope / tan(talus) - 1 of the steepest cell in each group of 8 that holds a flagged cell, from a
/// loaded patch. ground: null where the sand is deep and of one kind. steepest: tile_area / 8 numbers, one
/// per group; those of other groups are left alone.
void compute_residuals(const TalusLaw& law, const TilePatch& patch, const GroundPatch* ground,
                       const CellFlags& cells, double* steepest);

/// A number for each cell of a tile, row-major.
struct alignas(64) TileSlopes : std::array<double, BedGeometry::tile_area> {};
/// Computes slope / tan(talus) of all cells of a loaded patch, by isotropic or by faces (there, of the
/// steepest face through which a cell would give). 0 for walls.
void compute_slopes(const TalusLaw& law, const TilePatch& patch, TileSlopes& slopes);

}  // namespace sandstroke
