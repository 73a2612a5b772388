#pragma once

#include "sand/cell_flags.h"
#include "sand/talus_law.h"
#include "sand/tile_patch.h"

namespace sandstroke {

/// What the sand of a tile does in one pass.
struct TileFlow {
  CellFlags moved{};  ///< cells whose gain was computed; that of others is 0
  alignas(64)
      std::array<double, BedGeometry::tile_area> gain{};  ///< m: inflow less outflow; in groups that moved
  double given = 0.0;                                     ///< m: sum of outflows
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

// Vector code (Highway) for the best instruction set of the machine. Each cell's expression is evaluated in
// the reference's order, without contraction, and sums run over 8 lanes whatever the vectors' width: the same
// bits everywhere.

/// The law's flow of the active cells, from a loaded patch. Cells at rest cost a comparison with their
/// neighbours. givers: none = all cells may give.
void compute_flow(const TalusLaw& law, TilePatch& patch, const CellFlags& active, const GiverFlags* givers,
                  TileFlow& flow);

/// heights += gain; flags the cells that are another number now. Returns false where none is.
bool apply_flow(const TileFlow& flow, double* heights, CellFlags& changed);

/// slope / tan(talus) - 1 of the steepest cell in each group of 8 that holds a flagged cell, from a loaded
/// patch. steepest: tile_area / 8 numbers; other groups' are left alone.
void compute_residuals(const TalusLaw& law, const TilePatch& patch, const CellFlags& cells, double* steepest);

// --- super time stepping (relaxation_rkl.cpp) ---

/// What a super-step keeps of a tile, in groups of 8 cells: bit g of a row's byte is its group g.
struct SuperStepTile {
  using Groups = std::array<std::uint8_t, BedGeometry::tile_side>;
  alignas(64) std::array<double, BedGeometry::tile_area> before;  ///< m: heights one stage ago ...
  alignas(
      64) std::array<double, BedGeometry::tile_area> first_gain;  ///< m: F0, the flow of the step's start ...
  Groups stepped;      ///< ... in groups that took part in a stage of this step
  Groups first_moved;  ///< ... in groups where it is not 0
};

/// How a flow F differs from F0.
struct FlowChange {
  double difference;  ///< m: max |F - F0|
  double product;     ///< m^2: sum F F0
};
/// Keeps a flow as F0; compares it with no flow and with itself: max |F0|, sum F0^2.
FlowChange keep_first_flow(const TileFlow& flow, SuperStepTile& tile);
FlowChange compare_flows(const TileFlow& flow, const SuperStepTile& tile);

/// Lowest and highest of some heights [m].
struct HeightRange {
  double low, high;
};
/// Of a tile's cells that lie inside the bed.
HeightRange range_of(const double* heights, int rows, int cols);

/// heights Y, tile.before Z: Y, Z = Y + momentum (Y - Z) + step F, Y, in the active cells' groups. Flags the
/// cells that are another number now. Returns the range of the active cells' new heights.
HeightRange super_stage(const TileFlow& flow, const CellFlags& active, double momentum, double step,
                        double* heights, SuperStepTile& tile, CellFlags& changed);

/// Undoes the last stage.
void take_back_stage(const SuperStepTile& tile, double* heights);

}  // namespace sandstroke
