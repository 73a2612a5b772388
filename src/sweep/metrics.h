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

/// What a point of a sweep came to. at_rest: as it should be. not_at_rest: relaxation.max_passes were not
/// enough. active: it came to rest, but the loop gave out energy. unstable: force or device left all bounds.
/// refused: the scene cannot be run.
enum class PointVerdict { at_rest, not_at_rest, active, unstable, refused };
inline const std::vector<std::string> verdict_names = {"at rest", "not at rest", "active", "unstable",
                                                       "refused"};
/// How many points came to each verdict.
using VerdictCounts = std::array<std::size_t, 5>;

/// No metrics came of it.
inline bool failed(PointVerdict verdict) {
  return verdict == PointVerdict::unstable || verdict == PointVerdict::refused;
}

/// What metrics are taken from.
struct PointOutcome {
  const RunResult& run;
  const SlopeMeasures& slopes;                   ///< where a metric needs them
  const std::optional<FieldDifference>& golden;  ///< the same; none where there is nothing to compare with
};

/// One number that is collected of each point.
struct Metric {
  enum Needs { run, slopes, golden, error };

  std::string name;   ///< max_force
  std::string title;  ///< "peak force"
  std::string unit;
  std::string definition;                     ///< its formula, in words
  double (*of)(const PointOutcome& outcome);  ///< not-a-number where it means nothing
  Needs needs = run;
  bool timing = false;  ///< differs from run to run
};

/// All there are, in the order in which they are shown.
const std::vector<Metric>& all_metrics();

/// The same, as `help metrics` lists them.
std::vector<KeySection> metric_keys();

/// Of one point.
struct PointResult {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  PointVerdict verdict = PointVerdict::at_rest;
  std::string reason;           ///< where it failed: the error's sentence
  std::vector<double> metrics;  ///< in the order of the sweep's; none where one means nothing
};

}  // namespace sandstroke
