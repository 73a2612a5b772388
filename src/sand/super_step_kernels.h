#pragma once

#include "sand/flow_kernels.h"

namespace sandstroke {

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
