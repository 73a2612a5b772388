#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sandstroke {

/// One column of a table of samples.
struct SampleColumn {
  std::string name;            ///< as in the file; "1", "2", ... where columns have no names
  std::string unit;            ///< as the file says it ("mm", "N"); empty: it does not, or in the name
  std::vector<double> values;  ///< one per sample, finite; empty: nobody asked for it
  /// Was taken off all values: of a clock's stamps, which no double holds.
  std::optional<std::int64_t> origin = {};
};

/// Instead of a unit of a column of times: it was dates, and has ns.
inline constexpr const char* iso_unit = "ISO 8601";

/// Samples as a file has them, whatever its format.
struct SampleTable {
  std::vector<SampleColumn> columns;  ///< of equal length, or empty
  std::vector<std::size_t> lines;     ///< of the file, one per sample; empty: it has none
  std::vector<bool> lifts;  ///< the pen lifts right after the sample; empty: nothing is said of a pen
  double rate = 0.0;        ///< Hz, where the file says it
  /// Above 0: no motion was sampled, but a path is told as straight lines from sample to sample. The tip may
  /// leave them by this, in the unit of the position.
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
