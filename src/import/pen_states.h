#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "haptics/table_settings.h"
#include "import/sample_table.h"
#include "import/table_layout.h"

namespace sandstroke {

/// The pen of each sample, and what is to be said about it.
struct PenStates {
  std::vector<std::uint8_t> contact;  ///< a PenState each; empty: the table tells nothing of a pen
  std::string text;                   ///< for people; empty: nothing
  std::vector<std::string> warnings;  ///< a sentence each
};

/// The pen as the reader (SampleTable::lifts) and the columns of stroke numbers and pen states tell it. A
/// column that was found by its name only counts if its values agree with that; otherwise, and where a column
/// is perhaps one, a warning says so. Samples whose column is missing (NaN) are up. `name` is the table's.
PenStates pen_states(const SampleTable& table, const TableLayout& layout, const TableSettings& settings,
                     const std::string& name);

}  // namespace sandstroke
