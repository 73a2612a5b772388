#pragma once

#include <cmath>

#include "fuzz.h"
#include "import/sample_table.h"

namespace sandstroke {

/// What every reader of samples guarantees.
inline void require_sound(const SampleTable& table) {
  require(table.size() > 0);
  for (const SampleColumn& column : table.columns) {
    require(column.values.size() == table.size());
    for (const double value : column.values) require(std::isfinite(value));
  }
  require(table.lines.empty() || table.lines.size() == table.size());
  require(table.lifts.empty() || table.lifts.size() == table.size());
}

}  // namespace sandstroke
