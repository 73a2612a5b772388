#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sweep/kept_surface.h"
#include "sweep/sweep_folder.h"

namespace sandstroke {

/// Of points that have no result, beside verdict_names.
inline const std::string missing_verdict = "missing";

/// How a sweep stands. done + failed + missing + unreadable = its points.
struct CollectReport {
  std::size_t done = 0, failed = 0;
  std::size_t missing = 0;           ///< not run yet
  std::size_t unreadable = 0;        ///< cut off or damaged: running the sweep again makes them again
  std::size_t surfaces_missing = 0;  ///< of points that are done, where surfaces are kept
  std::string content_hash;
  std::vector<std::string> sentences;  ///< worth saying
};

/// All points of a sweep, as far as they are there.
struct CollectedSweep {
  /// Reads them, and says in the report what is missing.
  CollectedSweep(const SweepFolder& of, CollectReport& report);

  /// Not-a-number where the point has none.
  double metric(std::size_t point, std::size_t metric) const;
  /// Index into verdict_names; their number stands for missing_verdict.
  std::size_t verdict(std::size_t point) const;
  const std::string& verdict_name(std::size_t point) const;
  /// Why it has no metrics; empty where it has, or is still to run.
  std::string reason(std::size_t point) const;

  const SweepFolder& folder;
  std::vector<std::optional<PointResult>> results;
  std::vector<bool> unreadable;
  std::vector<std::optional<KeptSurface>> surfaces;
  std::optional<BedGeometry> bed;  ///< of all surfaces; none where none was kept, or they differ
};

/// Of axes, verdicts, metrics (but for timings) and surfaces: the same for two sweeps with the same content,
/// wherever and in whatever order they ran. Not of reasons: they name files as each call found them.
std::string content_hash(const CollectedSweep& sweep);

}  // namespace sandstroke
