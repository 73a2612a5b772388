#pragma once

#include "sand/flow_kernels.h"

namespace sandstroke {

/// What a super-step keeps of a tile.
struct SuperStepTile {
  /// Groups of 8 cells: bit g of a row's byte is its group g.
  using Groups = std::array<std::uint8_t, BedGeometry::tile_side>;
  /// m: heights one stage ago, in the groups of `stepped`.
  alignas(64) std::array<double, BedGeometry::tile_area> before;
  /// m: F0, the flow of the step's start, in the groups of `first_moved`; elsewhere it is 0.
  alignas(64) std::array<double, BedGeometry::tile_area> first_gain;
  Groups stepped, first_moved;
};

struct FlowSize {
  double peak;    ///< m: max |F|
  double square;  ///< m^2: sum F^2
};
/// Keeps a flow as F0.
FlowSize keep_first_flow(const TileFlow& flow, SuperStepTile& tile);

/// How a flow F differs from F0.
struct FlowChange {
  double difference;  ///< m: max |F - F0|
  double product;     ///< m^2: sum F F0
};
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
