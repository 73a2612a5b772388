#pragma once

#include <optional>

#include "rules/talus.h"
#include "sand/super_step_tile.h"

namespace sandstroke {

/// What the sand of a tile does in one pass.
struct TileFlow {
  RowSpan rows;       ///< those with active cells: what follows is of them
  CellFlags moved{};  ///< cells whose gain was computed; that of others is 0
  /// m: inflow less outflow; in groups that moved.
  alignas(64) std::array<double, BedGeometry::tile_area> gain{};
  double given = 0.0;  ///< m: sum of outflows
  // In super-steps:
  double axis_drop = 0.0;      ///< m: the largest drop between neighbours that was met (others: dx |g|)
  double diagonal_drop = 0.0;  ///< m: the same between diagonal ones (paper law)
  double change = 0.0;         ///< m: max |F - F0|
  double product = 0.0;        ///< m^2: sum F F0
};

/// What a pass needs besides, for one tile after the other.
struct FlowScratch {
  /// The part of each drop that a cell gives away, or what flows to the right of it; laid out like a patch.
  alignas(64) std::array<double, TilePatch::size> factors{};
  alignas(64) std::array<double, TilePatch::size> below{};  ///< what flows down from it (law: faces)
  /// The cells that may give in a super-step, of a tile and one cell around it; all others are held still.
  struct Row {
    std::uint64_t own;
    bool west, east;
  };
  std::array<Row, BedGeometry::tile_side + 2> givers;  ///< from row -1; those around the active rows

  /// Each thread has one, so that its memory is made once and shared with nobody.
  static FlowScratch& of_this_thread();
};

// Vector code (Highway) for the best instruction set of the machine, with the same bits in all of them: each
// cell's expression is evaluated in one order, without contraction, and sums run over 8 lanes.

/// What a super-step has to do with a tile's flow.
struct FlowInStep {
  const FirstFlow* first = nullptr;  ///< only the scratch's givers may give; none: no super-step, and all may
  std::optional<StageAhead> ahead{};  ///< flow.gain is left alone then
};

/// The law's flow of the active cells, all in `rows`, from a patch that holds them and two cells around them.
/// Cells at rest cost a comparison with their neighbours.
void compute_flow(const TalusLaw& law, const TilePatch& patch, const CellFlags& active, RowSpan rows,
                  const FlowInStep& in_step, FlowScratch& scratch, TileFlow& flow);

/// heights += gain; flags, in the flow's rows, the cells that are another number now.
void apply_flow(const TileFlow& flow, TilePatch& patch, CellFlags& changed);

/// slope / tan(talus) - 1 of the steepest cell in each group of 8 that holds a flagged cell, from a loaded
/// patch. steepest: tile_area / 8 numbers; other groups' are left alone.
void compute_residuals(const TalusLaw& law, const TilePatch& patch, const CellFlags& cells, double* steepest);

}  // namespace sandstroke
