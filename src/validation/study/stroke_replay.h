#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/solution.h"
#include "validation/study/problem.h"

namespace sandstroke {

/// What one run of a stroke leaves behind.
struct Replay {
  RunResult result;
  HeightGrid heights;
  std::vector<Eigen::Vector3d> force, position;  ///< of the device, 100 times a second
};

/// From the scene's own surface. The servo rate is a multiple of 100 Hz.
Replay replay(const Scene& scene, const Stroke& stroke);

/// Against a run on as fine a grid or a finer one, that began flat.
Score judge(const Replay& run, const Replay& truth);

/// What a run of the scene says of its error, beside its distance to the truth.
std::vector<ErrorCheck> check_errors(const std::string& label, const Scene& scene, const Stroke& stroke,
                                     const Replay& truth);

Contender stroke_contender(const std::string& series, const std::string& label, const Scene& scene,
                           int threads, double step, const Stroke& stroke,
                           const std::shared_ptr<const Replay>& truth);

}  // namespace sandstroke
