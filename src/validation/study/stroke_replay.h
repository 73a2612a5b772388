#pragma once

#include <memory>
#include <string>
#include <vector>

#include "measure/solution.h"
#include "validation/study/problem.h"

namespace sandstroke {

/// The results of one run of a stroke.
struct Replay {
  RunResult result;
  HeightGrid heights;
  std::vector<Eigen::Vector3d> force, position;  ///< of the device, 100 times a second
};

/// Runs a stroke on the scene's starting surface. The servo rate must be a multiple of 100 Hz.
Replay replay(const Scene& scene, const Stroke& stroke);

/// Compares with a run on the same grid or a finer one. Both runs began flat.
Score judge(const Replay& run, const Replay& truth);

/// Runs the scene, and compares its estimates of its own error with its distance to the truth.
std::vector<ErrorCheck> check_errors(const std::string& label, const Scene& scene, const Stroke& stroke,
                                     const Replay& truth);

Contender stroke_contender(const std::string& series, const std::string& label, const Scene& scene,
                           int threads, double step, const Stroke& stroke,
                           const std::shared_ptr<const Replay>& truth);

}  // namespace sandstroke
