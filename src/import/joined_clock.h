#pragma once

#include <string>

#include "import/sample_table.h"
#include "import/table_layout.h"

namespace sandstroke {

/// Joins a clock in two columns, whole seconds and their ms, us or ns, to one in the column of the seconds:
/// ns since the first sample, exactly. Rows in which one of them is missing become NaN. If the seconds have
/// fractions themselves, they stay as they are. Error: input, if the fractions are not those of whole
/// seconds.
void join_clock(SampleTable& table, const TableLayout& layout, const std::string& name);

}  // namespace sandstroke
