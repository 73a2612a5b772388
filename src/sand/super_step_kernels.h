#pragma once

#include "sand/flow_kernels.h"

namespace sandstroke {

struct FlowSize {
  double peak;    ///< m: max |F|
  double square;  ///< m^2: sum F^2
};
/// Keeps a flow as F0.
FlowSize keep_first_flow(const TileFlow& flow, FirstFlow& first);

/// The range of a tile's heights inside the bed, wherever they lie in memory.
HeightRange range_of(const double* heights, int rows, int cols);

/// Takes a stage in the active cells' groups. With Y the heights and Z = tile.before: the new Y is Y +
/// momentum (Y - Z) + step F, the new Z is the old Y. Flags the cells whose height changed, in the flow's
/// rows. Returns the range of the active cells' new heights.
HeightRange super_stage(const TileFlow& flow, const CellFlags& active, double momentum, double step,
                        TilePatch& patch, SuperStepTile& tile, CellFlags& changed);

/// Undoes the last stage.
void take_back_stage(const SuperStepTile& tile, TilePatch& patch);

}  // namespace sandstroke
