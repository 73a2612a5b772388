#pragma once

#include <optional>
#include <vector>

#include "core/error.h"
#include "sim/simulation.h"
#include "sweep/metrics.h"

namespace sandstroke {

/// What points with the same sand start from, and how each of them is felt.
struct SharedRun {
  std::vector<Scene> scenes;  ///< at least one; of one sand_key
  HeightField bed;
  std::optional<Stroke> stroke;  ///< as it is played
};

/// The result of a point that an error ended; so many metrics, none of which it has.
PointResult failed_point(const Error& error, std::size_t metrics);

struct SharedRunResult {
  std::vector<PointResult> points;  ///< of each scene, with these metrics
  HeightField surface;              ///< the final one; of points that did not fail
};

/// Runs them all by one simulation: with a kinematic device the sand is the same whatever the force
/// constants, so that each tick's sand is felt with each of them. A result is the same bits as if its scene
/// had been run alone. golden: what surfaces are compared with, or none. Nothing where it was interrupted().
std::optional<SharedRunResult> run_shared(const SharedRun& run, const std::vector<Metric>& metrics,
                                          const HeightField* golden);

}  // namespace sandstroke
