#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sandstroke {

/// One setting that a sweep varies, and the values it takes.
struct SweepAxis {
  std::string key;                  ///< the setting's dotted name in a scene
  std::string unit;                 ///< the setting's unit; empty: none
  bool logarithmic = false;         ///< its values are spread evenly on a logarithmic scale
  std::vector<std::string> values;  ///< TOML literals
  bool of_range = false;            ///< its values come from a range, not from a list

  /// True if every value is a number.
  bool numeric() const;
  double number(std::size_t value) const;
  /// The value for people: as in the plan, strings without quotes.
  std::string label(std::size_t value) const;
};

/// The points of a sweep. A point's index determines all its settings.
struct SweepDesign {
  /// True: every combination of values, the last axis varies fastest. False (a Latin hypercube): point i
  /// takes value i of each axis.
  bool grid = true;
  std::vector<SweepAxis> axes;

  /// The shape of arrays with a value per point: a length per axis, or the number of points.
  std::vector<std::size_t> shape() const;
  std::size_t points() const;
  /// The index of an axis's value at a point.
  std::size_t value_at(std::size_t point, std::size_t axis) const;
  /// "key=value" for each axis, in the form of --set.
  std::vector<std::string> settings(std::size_t point) const;
};

/// Rounds to 12 digits, so that 0.1 + 2 x 0.1 is 0.3. Values below 1e-12 of `size` become 0, so that -0.3 + 3
/// x 0.1 is 0.
double rounded(double value, double size);

/// Spreads `count` >= 1 numbers evenly from `from` to `to`, or evenly on a logarithmic scale (from, to > 0).
/// The ends are exact, the others rounded().
std::vector<double> spread(double from, double to, std::size_t count, bool logarithmic);

/// Which of n indices to look at: all, or `most` (at least 2) spread evenly, with the first and the last.
std::vector<std::size_t> spread_indices(std::size_t n, std::size_t most);

/// Latin hypercube (McKay, Beckman & Conover 1979): for each axis n numbers in [0, 1), one at a random
/// position in each n-th of it, in random order. The same seed gives the same numbers on any machine.
std::vector<std::vector<double>> latin_hypercube(std::size_t axes, std::size_t n, std::uint32_t seed);

}  // namespace sandstroke
