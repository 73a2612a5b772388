#pragma once

#include <optional>
#include <string>
#include <vector>

#include "haptics/stroke.h"
#include "measure/error_estimate.h"
#include "sweep/metrics.h"

namespace sandstroke {

/// Makes the result of a point that failed, with `metrics` empty metrics.
PointResult failed_point(PointVerdict verdict, const std::string& reason, std::size_t metrics);

struct SharedRunResult {
  std::vector<PointResult> points;  ///< one for each scene
  HeightField surface;              ///< the final surface of the points that did not fail
};

/// Runs scenes with the same sand_key, at least one, in one simulation. With a kinematic device the force
/// constants do not change the sand, so a device for each scene feels the sand of each tick. Each result has
/// the same bits as if its scene had run alone. stroke: the placed stroke, or none. golden: the surface to
/// compare with, or none. second: the second solution for each scene's error estimate. Nothing if
/// interrupted(). Error: io.
std::optional<SharedRunResult> run_shared(const std::vector<Scene>& scenes, const HeightField& bed,
                                          const Stroke* stroke, const std::vector<Metric>& metrics,
                                          const HeightField* golden,
                                          std::optional<SecondSolution> second = {},
                                          const Checkpoints& checkpoints = {});

}  // namespace sandstroke
