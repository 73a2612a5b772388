#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sandstroke {

/// One column of a table of samples.
struct SampleColumn {
  std::string name;  ///< as in the file; "1", "2", ... if columns have no names
  std::string unit;  ///< as in the file ("mm", "N"); empty: none, or only in the name
  /// One per sample; not finite where the file has no number. Empty: the column is not used.
  std::vector<double> values;
  /// The number that was subtracted from all values: the first of a clock's stamps, which no double holds.
  std::optional<std::int64_t> origin = {};
};

/// False also for a value that is missing.
inline bool has_fraction(double value) { return std::isfinite(value) && value != std::floor(value); }

/// The unit of a column of times that were dates; its values are in ns.
inline constexpr const char* iso_unit = "ISO 8601";
/// The unit of a column of seconds that was joined with one of their fractions; its values are in ns.
inline constexpr const char* joined_unit = "s, and their fractions in a second column";

/// Samples as they are in a file of any format.
struct SampleTable {
  std::vector<SampleColumn> columns;  ///< of equal length, or empty
  std::vector<std::size_t> lines;     ///< line of each sample in the file; empty: it has none
  std::vector<bool> lifts;  ///< the pen lifts right after the sample; empty: the file tells nothing of a pen
  /// > 0: the samples are not of a motion, but corners of a path of straight lines. The tip may leave the
  /// lines by this, in the unit of the position.
  double line_tolerance = 0.0;
  std::vector<std::string> warnings;  ///< a sentence each
  std::string description;            ///< for people: "semicolons, decimal commas, 7 columns, 12,040 rows"

  std::size_t size() const {
    std::size_t most = 0;
    for (const SampleColumn& column : columns) most = std::max(most, column.values.size());
    return most;
  }
};

}  // namespace sandstroke
