#pragma once

#include <limits>

#include "sand/height_field.h"
#include "sand/relaxation.h"

namespace sandstroke {

/// Slopes of the cells that changed and have sand. NaN: there are none.
struct SlopeMeasures {
  double mean = std::numeric_limits<double>::quiet_NaN();               ///< deg, by descent_slope()
  double steepest = std::numeric_limits<double>::quiet_NaN();           ///< deg, by descent_slope()
  double law_steepest = std::numeric_limits<double>::quiet_NaN();       ///< deg, by law_slope()
  double fraction_at_talus = std::numeric_limits<double>::quiet_NaN();  ///< fraction of these cells within 1
                                                                        ///< degree of their talus angle
};

/// Steepest way down from a cell, rise over run, over the eight triangles that its centre makes with the
/// centres of its neighbours (Tarboton 1997, Water Resources Research 33, "D-infinity"). 0 in a pit. Exact on
/// planes of any direction; on a crest or an edge it is the slope of the flank. (Central differences give 0
/// on a crest and too little beside it. The paper's law looks in eight directions only.) Sand at rest by the
/// paper's law is at most tan(talus) x 1.0824 steep by this measure, like its octagon. Where contours bend
/// within a cell, sand at rest by the isotropic law may be steeper than by the law's upwind slope: in drags
/// at 5 cells per tool radius up to 34.0 degrees for 30. (The upwind slope in turn gives 38.9 for sand of the
/// paper's law: it adds both axes on every peak.)
double descent_slope(const HeightField& bed, int row, int col);

/// Steepest slope of a cell, rise over run, as a law of relaxation (sand/relaxation.h) compares it with
/// tan(talus): paper: the largest drop to one of 8 neighbours over its distance; isotropic: the upwind slope;
/// faces: the slope of the steepest face through which the cell may give.
double law_slope(const HeightField& bed, int row, int col, RelaxationLaw law);

/// Measures slopes over the cells whose height changed; `settings` relaxed them. Both fields have the same
/// shape. Tiles that exist in neither field cost nothing if both have the same level there.
SlopeMeasures measure_slopes(const HeightField& initial, const HeightField& final,
                             const RelaxationSettings& settings);

}  // namespace sandstroke
