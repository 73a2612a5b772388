#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sandstroke {

/// One column of a table of samples.
struct SampleColumn {
  std::string name;            ///< as in the file, without its unit; "1", "2", ... where columns have no names
  std::string unit;            ///< as the file says it ("mm", "N"); empty: it does not
  std::vector<double> values;  ///< one per sample, finite
};

/// Samples as a file has them, whatever its format.
struct SampleTable {
  std::vector<SampleColumn> columns;  ///< of equal length
  std::vector<std::size_t> lines;     ///< of the file, one per sample; empty: it has none
  std::vector<bool> lifts;            ///< the pen lifts right after the sample; empty: nothing is said of a pen
  double rate = 0.0;                  ///< Hz, where the file says it
  std::string description;  ///< for people: "semicolons, decimal commas, 7 columns, 12,040 rows"

  std::size_t size() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

}  // namespace sandstroke
