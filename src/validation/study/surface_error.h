#pragma once

#include <vector>

#include "validation/study/exact_shapes.h"

namespace sandstroke {

/// The distance of a surface from the exact one.
struct SurfaceError {
  double l1 = 0.0;       ///< sum |h - exact| / sum |exact - start|, a fraction of the sand that has to move
  double rms = 0.0;      ///< m, over the whole bed
  double largest = 0.0;  ///< m
};

/// Takes the exact surface at cell centres.
SurfaceError surface_error(const HeightField& bed, const HeightField& start, const ExactSurface& exact);
/// All grids have the same size. Heights in m.
SurfaceError surface_error(const HeightGrid& heights, const HeightGrid& start, const HeightGrid& exact);

/// The directions in which flanks are measured: 0, 10, ..., 350 degrees from +x towards +y.
std::vector<double> flank_directions();

/// A slope between two distances [m] from the origin, up or down; `slope` is rise over run.
struct Flank {
  double slope, inner, outer;
};
/// For each direction, how much too steep [deg] the bed is: by the least-squares line through the cells
/// within 5 degrees of it, between 0.2 and 0.8 of the flank.
std::vector<double> flank_slope_errors(const HeightField& bed, const Flank& flank);

/// How steep [deg] a heap falls from the origin in a direction [deg from +x towards +y], between two heights
/// [m]: by the least-squares line through the surface between cells.
double slope_along(const HeightField& bed, double direction, double low, double high);

}  // namespace sandstroke
