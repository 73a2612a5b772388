#pragma once

#include <vector>

#include "validation/study/exact_shapes.h"

namespace sandstroke {

/// How far a surface is from what it should be.
struct SurfaceError {
  double l1 = 0.0;       ///< sum |h - exact| / sum |exact - start|: of the sand that has to move
  double rms = 0.0;      ///< m, over the whole bed
  double largest = 0.0;  ///< m
};

/// The exact surface is taken at cell centres. Neither bed is touched.
SurfaceError surface_error(const HeightField& bed, const HeightField& start, const ExactSurface& exact);
/// All grids of one size; heights in m.
SurfaceError surface_error(const HeightGrid& heights, const HeightGrid& start, const HeightGrid& exact);

/// In which directions flanks are measured: 0, 10, ..., 350 degrees from +x towards +y.
std::vector<double> flank_directions();

/// A slope between two distances [m] from the origin, up or down, as steep as `slope` (rise over run).
struct Flank {
  double slope, inner, outer;
};
/// By direction: how much steeper [deg] than it should be is the least-squares line through the cells within
/// 5 degrees of it, between 0.2 and 0.8 of the flank.
std::vector<double> flank_slope_errors(const HeightField& bed, const Flank& flank);

}  // namespace sandstroke
