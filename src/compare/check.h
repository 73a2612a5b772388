#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/tolerances.h"

namespace sandstroke {

/// One thing that was compared, and what came out.
struct Check {
  static constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

  std::string name;  ///< "final height"
  bool passed = false;
  double measured = no_number;  ///< in `unit`; NaN where nothing could be measured
  double limit = no_number;     ///< in `unit`; NaN where there is no number to stay below
  std::string unit;
  std::string sentence;  ///< what was found and where
  double seconds = 0.0;  ///< for this check, with the shared work that it is the first to need
};

/// A check that passes where measured <= limit. It fails where measured is NaN.
Check limit_check(std::string name, double measured, double limit, std::string unit, std::string sentence);

/// A check of a fact, without numbers.
Check fact_check(std::string name, bool passed, std::string sentence);
Check passed_check(std::string name, std::string sentence);
Check failed_check(std::string name, std::string sentence);

/// The checks of one pair of runs or pictures, or of one scene.
struct Comparison {
  std::string name;
  std::vector<Check> checks;
  std::vector<UsedTolerance> tolerances = {};  ///< that the checks used
  std::string settings = {};                   ///< of the scenes that differ (scene_difference()); no check

  /// True where all checks pass and there is at least one: comparing nothing is not a success.
  bool passed() const;
  int failures() const;
  /// The largest of its measures over their limits, among those with a unit; infinity where another check
  /// failed.
  double worst() const;
  double seconds() const;  ///< of all checks
};

/// One aligned line per check (name, measured, limit, ok or FAILED), then the sentences of those that failed,
/// and the settings that differ.
std::string check_table(const Comparison& comparison);

/// "same within the tolerances", or "differs: " and the names of the checks that failed.
std::string verdict(const Comparison& comparison);

/// {"name", "passed", "checks": [{"name", "passed", "measured", "limit", "unit", "sentence"}],
/// "tolerances": [{"name", "value", "unit", "source"}], "settings"}; NaN becomes null.
nlohmann::json to_json(const Comparison& comparison);

}  // namespace sandstroke
