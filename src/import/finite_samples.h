#pragma once

#include <cmath>
#include <string>

#include "core/error.h"
#include "import/sample_table.h"

namespace sandstroke {

/// Checks that samples are still finite after a reader has calculated with a file's numbers. Error: input.
inline SampleTable finite_samples(SampleTable table, const std::string& name) {
  for (const SampleColumn& column : table.columns)
    for (std::size_t i = 0; i < column.values.size(); ++i)
      if (!std::isfinite(column.values[i]))
        throw_input_error("{}: {} of sample {} is too large; correct its unit, rate or speed", name,
                          column.name, i + 1);
  return table;
}

}  // namespace sandstroke
