#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace sandstroke {

/// A curve as a page draws it.
struct Curve {
  std::vector<double> at;     ///< in order: times, say
  std::vector<double> value;  ///< one for each position; NaN: a gap
  void add(double position, double height) {
    at.push_back(position);
    value.push_back(height);
  }
};

/// A curve with at most about `most` points in place of a longer one. It has most / 2 stretches with equally
/// many points. Each keeps its least and greatest point, in their order, and the first point that is not
/// finite, if any. So every extreme stays as it is, where it is. Each position has a value.
Curve thinned_curve(const Curve& curve, std::size_t most);

/// {at, value}, thinned to what a page can draw.
nlohmann::ordered_json curve_json(const Curve& curve);
inline constexpr std::size_t most_points = 2000;
inline constexpr std::string_view curves_are_thinned =
    "A curve with more than 2000 points shows the least and the greatest value of each stretch, so that no "
    "extreme is lost.";

}  // namespace sandstroke
