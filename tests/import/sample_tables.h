#pragma once

#include <limits>
#include <string>
#include <vector>

#include "import/sample_table.h"
#include "import/stroke_of_table.h"

namespace sandstroke {

inline constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// A table as a reader makes it. The first line of the file is a header.
inline SampleTable table_of(std::vector<SampleColumn> columns) {
  SampleTable table;
  table.columns = std::move(columns);
  for (std::size_t i = 0; i < table.size(); ++i) table.lines.push_back(i + 2);
  return table;
}

/// The number of warnings that hold this text.
inline int warnings_with(const ImportedStroke& made, const std::string& text) {
  int count = 0;
  for (const std::string& warning : made.warnings) count += warning.find(text) != std::string::npos;
  return count;
}

}  // namespace sandstroke
