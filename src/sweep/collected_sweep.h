#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sweep/kept_surface.h"
#include "sweep/sweep_folder.h"

namespace sandstroke {

/// The verdict of points without a result, in addition to verdict_names.
inline const std::string missing_verdict = "missing";

/// Counts of a sweep's points. done + failed + missing + unreadable = all points.
struct CollectReport {
  std::size_t done = 0, failed = 0;
  std::size_t missing = 0;           ///< not run yet
  std::size_t unreadable = 0;        ///< cut off or damaged: the next call of sweep runs them again
  std::size_t surfaces_missing = 0;  ///< missing surfaces of done points, if surfaces are kept
  std::string content_hash;
  std::vector<std::string> sentences;  ///< messages for the user
};

/// All points that a sweep has so far.
struct CollectedSweep {
  /// Reads the points, and reports what is missing.
  CollectedSweep(const SweepFolder& of, CollectReport& report);

  /// NaN if the point has no such metric.
  double metric(std::size_t point, std::size_t metric) const;
  /// Index into verdict_names, or their count for missing_verdict.
  std::size_t verdict(std::size_t point) const;
  const std::string& verdict_name(std::size_t point) const;
  /// Why the point has no metrics. Empty if it has them or did not run yet.
  std::string reason(std::size_t point) const;

  const SweepFolder& folder;
  std::vector<std::optional<PointResult>> results;
  std::vector<bool> unreadable;
  std::vector<std::optional<KeptSurface>> surfaces;
  std::optional<BedGeometry> bed;  ///< bed of all surfaces; none if they differ or none was kept
};

/// Hashes axes, verdicts, metrics (without timings) and surfaces. Two sweeps with the same content have the
/// same hash, wherever and in whatever order they ran. Reasons are not hashed: they name files as each call
/// found them.
std::string content_hash(const CollectedSweep& sweep);

}  // namespace sandstroke
