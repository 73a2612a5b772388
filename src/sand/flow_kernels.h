#pragma once

#include <optional>

#include "rules/talus.h"
#include "sand/flux_tile.h"
#include "sand/ground_patch.h"

namespace sandstroke {

/// The flow of a tile's sand in one pass.
struct TileFlow {
  RowSpan rows;       ///< rows with active cells; all below is about them
  CellFlags moved{};  ///< cells whose gain was computed; other cells gain 0
  /// m: inflow less outflow, in the groups of the moved cells.
  alignas(64) std::array<double, BedGeometry::tile_area> gain{};
  double given = 0.0;  ///< m: sum of outflows
  // Filled in super-steps only:
  double axis_drop = 0.0;      ///< m: the largest drop between axis neighbours (paper law), or dx |g|
  double diagonal_drop = 0.0;  ///< m: the largest drop between diagonal neighbours (paper law)
  double change = 0.0;         ///< m: max |F - F0|
  double product = 0.0;        ///< m^2: sum F F0
};

/// Scratch memory of a pass, used for one tile after the other.
struct FlowScratch {
  /// The fraction of each drop that a cell gives, or what flows to its right [m] (law: faces); laid out like
  /// a patch.
  alignas(64) std::array<double, TilePatch::size> factors{};
  alignas(64) std::array<double, TilePatch::size> below{};  ///< m, what flows down from it (law: faces)
  /// The cells that may give in a super-step, in a tile and one cell around it; no others may.
  struct Row {
    std::uint64_t own;
    bool west, east;
  };
  std::array<Row, BedGeometry::tile_side + 2> givers;  ///< from row -1: the active rows, one on each side
  // On a ground only:
  /// The cells that give all they may, in a tile and one cell around it: from row -1.
  std::array<Row, BedGeometry::tile_side + 2> films;
  alignas(64) std::array<double, TilePatch::size> scales{};  ///< of what each cell gives (law: faces)

  /// Each thread has its own, so that its memory is allocated once and never shared.
  static FlowScratch& of_this_thread();
};

// Vector code (Highway) for the best instruction set of the machine, with the same bits in all of them: each
// cell's expression is evaluated in one order, without contraction, and sums run over 8 lanes.

/// Options of compute_flow for a super-step.
struct FlowInStep {
  const FirstFlow* first = nullptr;   ///< set: only the scratch's givers may give; null: all cells may
  std::optional<StageAhead> ahead{};  ///< set: takes this stage, and leaves flow.gain alone
  /// set (law isotropic only): what multiplies |g|^2 in each cell, so that its talus slope is another
  const TilePatch* slope_weights = nullptr;
  const GroundPatch* ground = nullptr;  ///< null: the sand is deep and of one kind
  /// set (over a floor, in a super-step): keeps what flows through each face. The gains are then for the
  /// step's controller only. They leave out films, which give all they may, and what comes from these: they
  /// pass on what they take, and tell nothing of the error of a step.
  TileFluxes* fluxes = nullptr;
};

/// Computes the law's flow of the active cells. All of them lie in `rows`; the patch holds them and two cells
/// around them. A cell at rest costs only a comparison with its neighbours.
void compute_flow(const TalusLaw& law, const TilePatch& patch, const CellFlags& active, RowSpan rows,
                  const FlowInStep& in_step, FlowScratch& scratch, TileFlow& flow);

/// heights += gain, but never below the ground's floor. Flags the cells whose height changed, in the flow's
/// rows.
void apply_flow(const TileFlow& flow, const GroundPatch* ground, TilePatch& patch, CellFlags& changed);

}  // namespace sandstroke
