#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace sandstroke {

/// A curve as a page draws it.
struct Curve {
  std::vector<double> at;     ///< in order: times, say
  std::vector<double> value;  ///< of each; NaN: a gap
  void add(double place, double height) {
    at.push_back(place);
    value.push_back(height);
  }
};

/// At most about `most` points that stand for all of a longer curve: of each of most / 2 stretches with
/// equally many points the least and the greatest, in their order, and the first that is not finite, if any.
/// So every extreme is kept, where and as it is. Each place has a value.
Curve thinned_curve(const Curve& curve, std::size_t most);

/// {at, value}, thinned to what a page can draw.
nlohmann::ordered_json curve_json(const Curve& curve);
inline constexpr std::size_t most_points = 2000;
inline constexpr std::string_view curves_are_thinned =
    "A curve with more than 2000 points shows of each stretch the least and the greatest value, so that no "
    "extreme is lost.";

}  // namespace sandstroke
