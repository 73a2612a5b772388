#pragma once

#include <memory>

#include "sand/ground.h"
#include "sand/tile_patch.h"

namespace sandstroke {

/// The ground under a tile and its rim, as the kernels read it.
struct GroundPatch {
  PatchHeights axis_drops;  ///< T of each cell [m] (TalusGround)
  PatchHeights floor;       ///< m; -infinity where it cannot matter
  bool has_floor = false;   ///< the floor can matter
  bool is_even = false;     ///< T of all these cells is only_drop
  double only_drop = 0.0;   ///< m

  /// Whether T of all these cells is this [m].
  bool has_only(double axis_drop) const { return is_even && only_drop == axis_drop; }
  /// Loads a tile (by index), unless it is loaded. The level floor matters only if `near_level`.
  void load(const std::shared_ptr<const Ground>& ground, int tile, bool near_level);

 private:
  std::shared_ptr<const Ground> ground_;
  int tile_ = -1;
  bool near_level_ = false;
};

}  // namespace sandstroke
