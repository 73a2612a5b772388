#pragma once

#include "sand/cell_flags.h"
#include "sand/talus_law.h"
#include "sand/tile_patch.h"

namespace sandstroke {

/// What the sand of a tile does in one pass.
struct TileFlow {
  CellFlags moved{};  ///< cells whose gain was computed; that of others is 0
  /// m: inflow less outflow; in groups that moved.
  alignas(64) std::array<double, BedGeometry::tile_area> gain{};
  double given = 0.0;  ///< m: sum of outflows
  // Where sand is held still (givers):
  double axis_drop = 0.0;      ///< m: the largest drop between neighbours that was met (isotropic: dx |g|)
  double diagonal_drop = 0.0;  ///< m: the same between diagonal ones (paper law)
};

/// The cells that may give, of a tile and one cell around it; all others are held still.
struct GiverFlags {
  struct Row {
    std::uint64_t own;
    bool west, east;
  };
  std::array<Row, BedGeometry::tile_side + 2> rows;  ///< from row -1
};

// Vector code (Highway) for the best instruction set of the machine, with the same bits in all of them: each
// cell's expression is evaluated in one order, without contraction, and sums run over 8 lanes.

/// The law's flow of the active cells, from a loaded patch. Cells at rest cost a comparison with their
/// neighbours. givers: none = all cells may give.
void compute_flow(const TalusLaw& law, TilePatch& patch, const CellFlags& active, const GiverFlags* givers,
                  TileFlow& flow);

/// heights += gain; flags the cells that are another number now. Returns false where none is.
bool apply_flow(const TileFlow& flow, double* heights, CellFlags& changed);

/// slope / tan(talus) - 1 of the steepest cell in each group of 8 that holds a flagged cell, from a loaded
/// patch. steepest: tile_area / 8 numbers; other groups' are left alone.
void compute_residuals(const TalusLaw& law, const TilePatch& patch, const CellFlags& cells, double* steepest);

}  // namespace sandstroke
