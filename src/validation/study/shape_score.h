#pragma once

#include <optional>

#include "validation/study/problem.h"
#include "validation/study/surface_error.h"

namespace sandstroke {

/// Sand that stays on a stone around the origin. What falls off is nobody's concern.
struct KeptSand {
  double radius;  ///< m, of the stone
  double volume;  ///< m^3, by a closed form
};

/// The flank of a heap at the origin.
struct HeapFlank {
  double direction, angle;  ///< deg from +x towards +y; deg, how steep it should be
  double low, high;         ///< m, heights between which it is measured
};

/// The shape in which a problem's sand comes to rest.
struct Shape {
  ExactSurface exact = {};             ///< none: only the flanks are known
  double height = 0.0;                 ///< m, of the exact surface
  std::optional<Flank> flank = {};     ///< the flank to measure the slope on, all around
  std::vector<HeapFlank> flanks = {};  ///< the same in some directions
  std::optional<KeptSand> kept = {};   ///< only the cells of the stone count
};

/// The work of a relaxation, and the bed's distance from its shape. Leaves out the volume drift, as a problem
/// may take sand away.
Score score_of(const HeightField& bed, const HeightField& start, const RelaxationOutcome& outcome,
               const Shape& shape);

/// Relaxes a bed, and scores that.
Trial relaxed_trial(const HeightField& start, const Shape& shape,
                    const std::function<RelaxationOutcome(HeightField&)>& relax);

/// A problem whose error is the misplaced sand (l1).
Problem shape_problem(const char* name, const char* title, const char* text);

}  // namespace sandstroke
