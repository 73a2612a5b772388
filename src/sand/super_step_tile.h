#pragma once

#include <memory>

#include "sand/cell_flags.h"
#include "sand/tile_patch.h"

namespace sandstroke {

/// Groups of 8 cells of a tile: bit g of a row's byte is its group g.
using CellGroups = std::array<std::uint8_t, BedGeometry::tile_side>;

/// The flow at the start of a super-step (F0).
struct FirstFlow {
  /// m: filled in the groups of `moved`; elsewhere the gain is 0.
  alignas(64) std::array<double, BedGeometry::tile_area> gain;
  CellGroups moved{};
  RowSpan rows;  ///< rows that hold these groups
};

/// The data of a tile in a super-step.
struct SuperStepTile {
  /// m: heights one stage ago, in the groups of `stepped`.
  std::unique_ptr<PatchHeights> before = std::make_unique<PatchHeights>();
  CellGroups stepped{};
  CellGroups same{};  ///< groups in which `before` equals the heights
  RowSpan rows;       ///< rows that hold the groups of `stepped`
  FirstFlow first;
};

/// Lowest and highest of some heights [m].
struct HeightRange {
  double low, high;
};

/// A stage that is taken in the same sweep as its flow, so that memory is passed once. The new heights go to
/// tile.before, in all of the tile's loaded rows; the heights stay as they are.
struct StageAhead {
  double momentum, step;
  SuperStepTile& tile;
  CellFlags& changed;  ///< in the flow's rows, the cells that the stage changes
  HeightRange& range;  ///< the active cells' after the stage
};

}  // namespace sandstroke
