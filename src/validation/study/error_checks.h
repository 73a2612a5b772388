#pragma once

#include "sim/error_estimate.h"
#include "validation/study/problem.h"

namespace sandstroke {

/// How far a solution is from the truth; not_applicable where that is not known.
struct TrueError {
  double height_share = not_applicable;  ///< as ErrorEstimate's
  double force_rms = not_applicable;     ///< N, over the ticks with a force
};

/// Solves a scene, lets it state its error from a coarser second solution and from a finer one, and puts both
/// beside the truth.
std::vector<ErrorCheck> check_errors(
    const std::string& label, const Scene& scene, const HeightField& start,
    const std::optional<Stroke>& stroke,
    const std::function<TrueError(const HeightField& surface, const std::vector<Eigen::Vector3d>& force)>&
        judge);

}  // namespace sandstroke
