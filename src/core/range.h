#pragma once

#include <limits>

namespace sandstroke {

/// Numbers that a setting accepts: finite, from lowest to highest. open: the ends themselves are not
/// accepted; whole: fractions are not accepted.
struct Range {
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();
  bool open = false;
  bool whole = false;

  /// True if the number is between the ends. This does not check whether it is whole.
  constexpr bool contains(double number) const {
    return open ? number > lowest && number < highest : number >= lowest && number <= highest;
  }
};
inline constexpr Range any_number{};
inline constexpr Range positive{0.0, std::numeric_limits<double>::max(), true};
inline constexpr Range not_negative{0.0, std::numeric_limits<double>::max(), false};
inline constexpr Range degrees{-360.0, 360.0, false};
inline constexpr Range sharp_angle{0.0, 90.0, true};       ///< deg
inline constexpr Range friction_angles{5.0, 60.0, false};  ///< deg, of sand

}  // namespace sandstroke
