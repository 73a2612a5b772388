#pragma once

#include <limits>

#include "sand/height_field.h"
#include "sand/relaxation.h"

namespace sandstroke {

/// Slopes of sand that moved. Not-a-number: none did.
struct SlopeMeasures {
  double mean = std::numeric_limits<double>::quiet_NaN();  ///< deg, descent_slope() over cells that changed
  double steepest = std::numeric_limits<double>::quiet_NaN();      ///< deg, of them
  double law_steepest = std::numeric_limits<double>::quiet_NaN();  ///< deg, of them by law_slope()
  double share_at_talus =
      std::numeric_limits<double>::quiet_NaN();  ///< of them, within 1 degree of the talus angle
};

/// Steepest way down from a cell, rise over run: over the eight triangles that its centre makes with those of
/// its neighbours (Tarboton 1997, Water Resources Research 33, "D-infinity"); 0 in a pit. Exact on planes of
/// any direction; on a crest or an edge it is the flank's. Central differences say 0 on a crest and are low
/// beside it; the paper's law itself knows eight directions only. Sand at rest by that law is at most
/// tan(talus) x 1.0824 steep by this measure, as its octagon is. Where contours bend within a
/// cell, sand at rest by the isotropic law may read steeper than by its own upwind slope: drags at 5 cells
/// per tool radius at most 34.0 degrees for 30 (in turn, its slope has sand of the paper's law at 38.9: it
/// adds both axes on every peak).
double descent_slope(const HeightField& bed, int row, int col);

/// Steepest slope of a cell, rise over run, as a law of relaxation (sand/relaxation.h) compares it with
/// tan(talus): paper: the largest drop to one of 8 neighbours over its distance; isotropic: the upwind slope;
/// faces: that of the steepest face through which the cell may give.
double law_slope(const HeightField& bed, int row, int col, RelaxationLaw law);

/// Over the cells whose height is not what it was; `settings` made them rest. Fields of one shape; tiles that
/// exist in neither cost nothing where both are the same there.
SlopeMeasures measure_slopes(const HeightField& initial, const HeightField& final,
                             const RelaxationSettings& settings);

}  // namespace sandstroke
