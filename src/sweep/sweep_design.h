#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sandstroke {

/// One setting that a sweep varies, and the values it takes.
struct SweepAxis {
  std::string key;                  ///< the setting's dotted name in a scene
  std::string unit;                 ///< the setting's; empty: none
  bool logarithmic = false;         ///< its values are spread evenly in their logarithm
  std::vector<std::string> values;  ///< TOML literals

  /// Every value is a number.
  bool numeric() const;
  double number(std::size_t value) const;
  /// For people: as the plan has it, strings without their quotes.
  std::string label(std::size_t value) const;
};

/// Which points a sweep has. All that a point is follows from its index.
struct SweepDesign {
  /// Every combination of values, the last axis fastest; otherwise (a Latin hypercube) point i takes value i
  /// of each axis.
  bool grid = true;
  std::vector<SweepAxis> axes;

  /// Of arrays with a value per point: a length per axis, or the number of points.
  std::vector<std::size_t> shape() const;
  std::size_t points() const;
  /// Which of its values an axis takes at a point.
  std::size_t value_at(std::size_t point, std::size_t axis) const;
  /// "key=value" for each axis, as --set takes them.
  std::vector<std::string> settings(std::size_t point) const;
};

/// To 12 digits, so that 0.1 + 2 x 0.1 is 0.3; and 0 where it is no more than that of numbers of that size,
/// so that -0.3 + 3 x 0.1 is 0.
double rounded(double value, double size);

/// Numbers from `from` to `to` [count >= 1], evenly spread, or evenly in their logarithm (from, to > 0), the
/// ends exactly, the others rounded.
std::vector<double> spread(double from, double to, std::size_t count, bool logarithmic);

/// Latin hypercube (McKay, Beckman & Conover 1979): for each of `axes`, n numbers in [0, 1), one in each
/// n-th, in an order of its own, and anywhere in it. The same for the same seed, on any machine.
std::vector<std::vector<double>> latin_hypercube(std::size_t axes, std::size_t n, std::uint32_t seed);

}  // namespace sandstroke
