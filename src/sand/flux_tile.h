#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <utility>

#include "sand/ground_patch.h"
#include "sand/super_step_tile.h"

namespace sandstroke {

/// What flows through the right and the lower faces of a tile's cells, and of one row and one column before
/// them [m]; laid out like a patch.
struct TileFluxes {
  std::unique_ptr<PatchHeights> right = std::make_unique<PatchHeights>(),
                                below = std::make_unique<PatchHeights>();
  /// Where something may flow, from row -1 on: bit g + 1 of a row is its group g, from -1 on. Elsewhere all
  /// are 0.
  std::array<std::uint16_t, PatchLayout::side + 1> groups{};
  RowSpan rows = {};  ///< that hold these groups

  TileFluxes() {
    right->fill(0.0);
    below->fill(0.0);
  }
  unsigned groups_in(int row) const { return row < rows.begin || row >= rows.end ? 0 : groups[row + 1]; }
  /// Nothing flows.
  void clear() {
    for (int row = rows.begin; row < rows.end; ++row)
      for (unsigned left = std::exchange(groups[row + 1], std::uint16_t{0}); left; left &= left - 1)
        for (PatchHeights* fluxes : {right.get(), below.get()})
          std::fill_n(fluxes->row(row) + (std::countr_zero(left) - 1) * cells_per_group, cells_per_group,
                      0.0);
    rows = {};
  }
  void swap(TileFluxes& other) {
    right.swap(other.right);
    below.swap(other.below);
    std::swap(rows, other.rows);
    groups.swap(other.groups);
  }
};

/// A tile in a super-step in flux form. Momentum on heights would take sand below a floor. So it goes with
/// the fluxes, and what each cell gives is limited to what it has:
///   D(j+1) = j/(j+1) D(j) + c (2j+1)/(j+1) f(Y(j)),  Y(j+1) = Y(j) - div (limited D(j+1)).
struct FluxTile {
  TileFluxes flow;   ///< f of the last compute_flow(), for c = 1; during a stage, its limited D
  TileFluxes stage;  ///< D, during a stage; between stages, that of the last one, limited
};

/// D of a tile and of those around it, row by row; null where nothing flows. The middle one is the tile's
/// own.
using FluxesAround = std::array<TileFluxes*, 9>;

/// stage = momentum * stage + step * flow.
void advance_fluxes(double momentum, double step, FluxTile& tile);

/// Takes the stage in the active cells' groups: limits D to what the cells have, and moves the sand. All
/// tiles around must have been advanced. Leaves the limited D in tile.flow. Otherwise like super_stage.
HeightRange flux_stage(const FluxesAround& around, const GroundPatch& ground, const CellFlags& active,
                       RowSpan rows, FluxTile& tile, TilePatch& patch, SuperStepTile& kept,
                       CellFlags& changed);

}  // namespace sandstroke
