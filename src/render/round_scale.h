#pragma once

#include <string>
#include <vector>

namespace sandstroke {

/// The smallest of 1, 2, 5 x 10^k that fits into `range` at most `most` times. range > 0 and finite, most >=
/// 1.
double round_interval(double range, int most);

/// A unit in which lengths up to some magnitude are short numbers.
struct LengthUnit {
  std::string name;  ///< "m", "mm", "um" or "nm"
  double metres;     ///< m per unit
};
LengthUnit length_unit(double magnitude);

/// A mark on a scale of lengths: where it is [m] and its number in the scale's unit.
struct ScaleTick {
  double value;
  std::string label;
};

/// Marks at every multiple of a round interval in [low, high] (m, low < high), at most `most` + 1 of them.
std::vector<ScaleTick> scale_ticks(double low, double high, const LengthUnit& unit, int most);

}  // namespace sandstroke
