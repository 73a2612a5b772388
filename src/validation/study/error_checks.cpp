#include "validation/study/error_checks.h"

#include <cmath>

namespace sandstroke {

std::vector<ErrorCheck> check_errors(
    const std::string& label, const Scene& scene, const HeightField& start,
    const std::optional<Stroke>& stroke,
    const std::function<TrueError(const HeightField& surface, const std::vector<Eigen::Vector3d>& force)>&
        judge) {
  Kept force(force_of);
  const Solution run = solve(scene, start, stroke, {&force});
  const TrueError truth = judge(run.surface, force.values);
  std::vector<ErrorCheck> checks;
  for (const auto& [which, name] :
       {std::pair(SecondSolution::coarser, "coarser"), std::pair(SecondSolution::finer, "finer")}) {
    const ErrorEstimate estimate = estimate_error(scene, start, stroke, run, force, which);
    const std::string second = label + ", from a " + name + " one";
    if (!std::isnan(truth.height_share))
      checks.push_back({{}, second, "height", estimate.height_share, truth.height_share});
    if (!std::isnan(truth.force_rms))
      checks.push_back({{}, second, "force", estimate.force_rms, truth.force_rms});
  }
  return checks;
}

}  // namespace sandstroke
