#include "validation/study/shape_score.h"

#include <cmath>

namespace sandstroke {

Score score_of(const HeightField& bed, const HeightField& start, const RelaxationOutcome& outcome,
               const Shape& shape) {
  Score score;
  const SurfaceError error = surface_error(bed, start, shape.exact);
  score.passes = static_cast<double>(outcome.passes);
  score.cells_visited = static_cast<double>(outcome.cells_visited);
  score.l1 = error.l1;
  score.rms_height = error.rms;
  score.rms_relative = error.rms / shape.height;
  score.largest_height = error.largest;
  score.largest_relative = error.largest / shape.height;
  score.converged = outcome.converged;
  if (shape.flank) {
    score.slope_errors = flank_slope_errors(bed, *shape.flank);
    for (const double slope_error : score.slope_errors)
      score.slope_error = std::fmax(score.slope_error, std::abs(slope_error));
  }
  return score;
}

Problem shape_problem(const char* name, const char* title, const char* text) {
  return {name, title, text, "l1", "misplaced sand, fraction of the sand that has to move", "", {}};
}

}  // namespace sandstroke
