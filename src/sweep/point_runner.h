#pragma once

#include <optional>
#include <string>
#include <vector>

#include "haptics/stroke.h"
#include "sim/error_estimate.h"
#include "sweep/metrics.h"

namespace sandstroke {

/// The result of a point that failed; so many metrics, none of which it has.
PointResult failed_point(PointVerdict verdict, const std::string& reason, std::size_t metrics);

struct SharedRunResult {
  std::vector<PointResult> points;  ///< of each scene, with these metrics
  HeightField surface;              ///< the final one; of points that did not fail
};

/// Runs scenes of one sand_key, at least one, by one simulation: with a kinematic device the sand is the same
/// whatever the force constants, so that each tick's sand is felt with each of them. A result is the same
/// bits as if its scene had been run alone. stroke: as it is played, or none; golden: what surfaces are
/// compared with, or none; second: estimate each scene's error, from this. Nothing where it was
/// interrupted(). Error: io.
std::optional<SharedRunResult> run_shared(const std::vector<Scene>& scenes, const HeightField& bed,
                                          const Stroke* stroke, const std::vector<Metric>& metrics,
                                          const HeightField* golden,
                                          std::optional<SecondSolution> second = {});

}  // namespace sandstroke
