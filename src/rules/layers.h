#pragma once

#include <vector>

namespace sandstroke {

// How strong sand is whose kind differs from place to place, told in multiples of one sand: the scene's own.
// Resistive stress at a point is the factor of the sand that is there, times the weight of the sand above it:
// the factor by which xi / (rho g) grows with friction, the weight by all the densities up to the surface.

/// Sand of another kind below a level plane.
struct ColumnLayer {
  double top;      ///< m, height of that plane
  double density;  ///< over the scene's own
  double factor;   ///< resistance() per density, over the scene's own
};

/// The sand along one vertical line.
struct SandColumn {
  double density = 1.0, factor = 1.0;  ///< of the uppermost sand
  std::vector<ColumnLayer> layers;     ///< below it, the highest first
  double blend = 1.0;                  ///< m, around a layer's top, over which its factor comes
};

/// The stress at a point, as a depth [m] in the scene's own sand at which that would have the same stress.
struct SandPressure {
  double depth;
  double growth;  ///< of that depth with the point's, by the sand that is there
  double change;  ///< the same, by the factor's change at a layer's top; may be negative
};
/// z [m]: height of the point. depth [m] >= 0: of the point below the surface.
SandPressure sand_pressure(const SandColumn& column, double z, double depth);

}  // namespace sandstroke
