#pragma once

#include <cstddef>
#include <string>

#include "core/error.h"

namespace sandstroke {

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
