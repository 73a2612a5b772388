#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "compare/field_difference.h"
#include "io/key_table.h"
#include "sim/run_result.h"
#include "sweep/slopes.h"

namespace sandstroke {

/// How a point of a sweep ended. at_rest: the normal end. not_at_rest: relaxation.max_passes were not enough.
/// active: at rest, but the loop gave out energy. unstable: force or device left all bounds. refused: the
/// scene cannot be run.
enum class PointVerdict { at_rest, not_at_rest, active, unstable, refused };
inline const std::vector<std::string> verdict_names = {"at rest", "not at rest", "active", "unstable",
                                                       "refused"};
/// The number of points with each verdict.
using VerdictCounts = std::array<std::size_t, 5>;

/// True if a point with this verdict has no metrics.
inline bool failed(PointVerdict verdict) {
  return verdict == PointVerdict::unstable || verdict == PointVerdict::refused;
}

/// The data from which metrics are computed.
struct PointOutcome {
  const RunResult& run;
  const SlopeMeasures& slopes;                   ///< filled in if a metric needs them
  const std::optional<FieldDifference>& golden;  ///< the same; none without a golden surface
};

/// One number that a sweep collects from each point.
struct Metric {
  enum Needs { run, slopes, golden, error };

  std::string name;   ///< max_force
  std::string title;  ///< "peak force"
  std::string unit;
  std::string definition;                     ///< its formula, in words
  double (*of)(const PointOutcome& outcome);  ///< NaN if it means nothing here
  Needs needs = run;
  bool timing = false;  ///< differs from run to run
};

/// All metrics, in the order in which they are shown.
const std::vector<Metric>& all_metrics();

/// The same, as `help metrics` lists them.
std::vector<KeySection> metric_keys();

/// The result of one point.
struct PointResult {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  PointVerdict verdict = PointVerdict::at_rest;
  std::string reason;           ///< the error sentence of a failed point
  std::vector<double> metrics;  ///< in the sweep's order; `none` if a metric means nothing
};

}  // namespace sandstroke
