#pragma once

#include "sand/flow_kernels.h"

namespace sandstroke {

struct FlowSize {
  double peak;    ///< m: max |F|
  double square;  ///< m^2: sum F^2
};
/// Keeps a flow as F0.
FlowSize keep_first_flow(const TileFlow& flow, FirstFlow& first);

/// Of a tile's cells that lie inside the bed.
HeightRange range_of(const double* heights, int rows, int cols);

/// heights Y, tile.before Z: Y, Z = Y + momentum (Y - Z) + step F, Y, in the active cells' groups. Flags, in
/// the flow's rows, the cells that are another number now. Returns the range of the active cells' new
/// heights.
HeightRange super_stage(const TileFlow& flow, const CellFlags& active, double momentum, double step,
                        TilePatch& patch, SuperStepTile& tile, CellFlags& changed);

/// Undoes the last stage.
void take_back_stage(const SuperStepTile& tile, TilePatch& patch);

}  // namespace sandstroke
