#pragma once

#include <optional>

#include "validation/study/problem.h"
#include "validation/study/surface_error.h"

namespace sandstroke {

/// The shape in which a problem's sand comes to rest.
struct Shape {
  ExactSurface exact;
  double height = 0.0;         ///< m, of the exact surface
  std::optional<Flank> flank;  ///< the flank to measure the slope on
};

/// The work of a relaxation, and the bed's distance from its shape. Leaves out the volume drift, as a problem
/// may take sand away.
Score score_of(const HeightField& bed, const HeightField& start, const RelaxationOutcome& outcome,
               const Shape& shape);

/// A problem whose error is the misplaced sand (l1).
Problem shape_problem(const char* name, const char* title, const char* text);

}  // namespace sandstroke
