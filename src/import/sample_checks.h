#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "core/error.h"
#include "import/sample_table.h"

namespace sandstroke {

// Checks of the samples that readers of several formats make.

/// Checks that samples are still finite after a reader has calculated with a file's numbers. Error: input.
inline SampleTable finite_samples(SampleTable table, const std::string& name) {
  for (const SampleColumn& column : table.columns)
    for (std::size_t i = 0; i < column.values.size(); ++i)
      if (!std::isfinite(column.values[i]))
        throw_input_error("{}: {} of sample {} is too large; correct its unit, rate or speed", name,
                          column.name, i + 1);
  return table;
}

/// Most points that the curves of one file are divided into. A short line may ask for a spiral of any length.
inline constexpr double most_curve_points = 5e6;

/// Checks a curve that adds `pieces` to the `points` before it. Error: input.
inline void check_curve_points(double pieces, std::size_t points, const std::string& file, std::size_t line) {
  if (pieces + static_cast<double>(points) <= most_curve_points) return;
  throw_input_error(
      "{}:{}: the curves up to here have more than {:g} points; correct the line or split the file", file,
      line, most_curve_points);
}

}  // namespace sandstroke
