#include "validation/study/shape_score.h"

#include <cmath>

#include "core/stopwatch.h"

namespace sandstroke {
namespace {

/// Judges the sand on a stone: the error of its volume, and of its surface there.
SurfaceError error_on_stone(const HeightField& bed, const HeightField& start, const Shape& shape,
                            double& volume_error) {
  HeightGrid heights = bed.grid(), before = start.grid(), exact = heights;
  double kept = 0.0;
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      const double x = bed.x_of(col), y = bed.y_of(row);
      if (std::hypot(x, y) < shape.kept->radius) {
        kept += (bed(row, col) - bed.floor(row, col)) * bed.cell_area();
        exact(row, col) = shape.exact(x, y);
      } else {
        before(row, col) = heights(row, col);
      }
    }
  volume_error = std::abs(kept / shape.kept->volume - 1.0);
  return surface_error(heights, before, exact);
}

}  // namespace

Score score_of(const HeightField& bed, const HeightField& start, const RelaxationOutcome& outcome,
               const Shape& shape) {
  Score score;
  score.passes = static_cast<double>(outcome.passes);
  score.cells_visited = static_cast<double>(outcome.cells_visited);
  score.converged = outcome.converged;
  if (shape.exact) {
    const SurfaceError error = shape.kept ? error_on_stone(bed, start, shape, score.volume_error)
                                          : surface_error(bed, start, shape.exact);
    score.l1 = error.l1;
    score.rms_height = error.rms;
    score.rms_relative = error.rms / shape.height;
    score.largest_height = error.largest;
    score.largest_relative = error.largest / shape.height;
  }
  const auto add_slope_error = [&](double off) {
    score.slope_error = std::fmax(score.slope_error, std::abs(off));
  };
  if (shape.flank) {
    score.slope_errors = flank_slope_errors(bed, *shape.flank);
    for (const double slope_error : score.slope_errors) add_slope_error(slope_error);
  }
  for (const HeapFlank& flank : shape.flanks)
    add_slope_error(slope_along(bed, flank.direction, flank.low, flank.high) - flank.angle);
  return score;
}

Trial relaxed_trial(const HeightField& start, const Shape& shape,
                    const std::function<RelaxationOutcome(HeightField&)>& relax) {
  HeightField bed = start;
  const Stopwatch watch;
  const RelaxationOutcome outcome = relax(bed);
  Trial trial{watch.seconds(), score_of(bed, start, outcome, shape)};
  trial.score.volume_drift = std::abs(bed.volume() - start.volume()) / outcome.moved_volume;
  return trial;
}

Problem shape_problem(const char* name, const char* title, const char* text) {
  return {name, title, text, "l1", "misplaced sand, fraction of the sand that has to move", "", {}};
}

}  // namespace sandstroke
