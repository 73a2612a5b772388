#pragma once

#include <optional>

#include "validation/study/problem.h"
#include "validation/study/surface_error.h"

namespace sandstroke {

/// What sand comes to where a problem ends.
struct Shape {
  ExactSurface exact;
  double height = 0.0;         ///< m, of the exact surface
  std::optional<Flank> flank;  ///< whose slope is measured
};

/// What a relaxation took and how far it left the bed from its shape. Without the volume drift: a problem may
/// take sand away.
Score score_of(const HeightField& bed, const HeightField& start, const RelaxationOutcome& outcome,
               const Shape& shape);

/// A problem whose error is the misplaced sand (l1).
Problem shape_problem(const char* name, const char* title, const char* text);

}  // namespace sandstroke
