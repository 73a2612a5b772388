#pragma once

#include "measure/error_estimate.h"
#include "validation/study/problem.h"

namespace sandstroke {

/// A solution's true error; not_applicable where the truth is not known.
struct TrueError {
  double height_share = not_applicable;  ///< as in ErrorEstimate
  double force_rms = not_applicable;     ///< N, over the ticks with a force
};

/// Solves a scene, estimates its error from a coarser and from a finer second solution, and compares both
/// estimates with the true error.
std::vector<ErrorCheck> check_errors(
    const std::string& label, const Scene& scene, const HeightField& start,
    const std::optional<Stroke>& stroke,
    const std::function<TrueError(const HeightField& surface, const std::vector<Eigen::Vector3d>& force)>&
        judge);

}  // namespace sandstroke
