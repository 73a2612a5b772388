#pragma once

#include <memory>

#include "sand/cell_flags.h"
#include "sand/tile_patch.h"

namespace sandstroke {

/// Groups of 8 cells of a tile: bit g of a row's byte is its group g.
using CellGroups = std::array<std::uint8_t, BedGeometry::tile_side>;

/// A flow that a super-step began with (F0).
struct FirstFlow {
  /// m: in the groups of `moved`; elsewhere it is 0.
  alignas(64) std::array<double, BedGeometry::tile_area> gain;
  CellGroups moved{};
  RowSpan rows;  ///< that hold those
};

/// What a super-step keeps of a tile.
struct SuperStepTile {
  /// m: heights one stage ago, in the groups of `stepped`.
  std::unique_ptr<PatchHeights> before = std::make_unique<PatchHeights>();
  CellGroups stepped{};
  CellGroups same{};  ///< groups in which it holds what the heights are
  RowSpan rows;       ///< that hold the groups of `stepped`
  FirstFlow first;
};

/// Lowest and highest of some heights [m].
struct HeightRange {
  double low, high;
};

/// A stage that is taken in one sweep with its flow, so that memory is passed once: what comes of it is left
/// in tile.before, all of the tile's loaded rows, and the heights stay as they are.
struct StageAhead {
  double momentum, step;
  SuperStepTile& tile;
  CellFlags& changed;  ///< in the flow's rows, the cells that would be another number then
  HeightRange& range;  ///< of the active cells then
};

}  // namespace sandstroke
