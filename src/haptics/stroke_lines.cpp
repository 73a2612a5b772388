#include "haptics/stroke_lines.h"

#include <type_traits>
#include <vector>

namespace sandstroke {
namespace {

/// A point on the line from one sample to the next.
struct PointOnLine {
  std::size_t sample;
  double fraction;  // of the line
};

/// The longest time [s] of a line if the curve's velocity is wrong by `velocity` at both ends. The cubic's
/// error is at most 4/27 of the time and of each end's error.
double time_in_tolerance(double velocity, double tolerance) { return tolerance * 27.0 / (8.0 * velocity); }

template <class Value>
Value between(const Value& a, const Value& b, double fraction) {
  if constexpr (std::is_integral_v<Value>)
    return a;
  else
    return a + fraction * (b - a);
}

std::vector<PointOnLine> points_on(const Stroke& stroke, double tolerance) {
  const auto time = [&](std::size_t i) { return stroke.time[i + 1] - stroke.time[i]; };
  const auto velocity = [&](std::size_t i) -> Eigen::Vector3d {
    return (stroke.position[i + 1] - stroke.position[i]) / time(i);
  };
  // The fraction of line i between its corner (of lines `before` and `before` + 1) and the sample close to
  // that; 0: it needs none.
  const auto close_fraction = [&](std::size_t i, std::size_t before) {
    const double corner = (velocity(before + 1) - velocity(before)).norm();
    const double longest = time_in_tolerance(corner, tolerance);
    return time(i) > longest ? 0.25 * longest / time(i) : 0.0;
  };
  std::vector<PointOnLine> points;
  const auto add = [&](std::size_t i, double fraction) {
    const double at = between(stroke.time[i], stroke.time[i + 1], fraction);
    const bool is_time = stroke.time[i] < at && at < stroke.time[i + 1];  // as doubles
    if (fraction > 0.0 && fraction < 1.0 && is_time) points.push_back({i, fraction});
  };
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    points.push_back({i, 0.0});
    if (!stroke.joined(i)) continue;
    if (i > 0 && stroke.joined(i - 1)) add(i, close_fraction(i, i - 1));
    if (stroke.joined(i + 1)) add(i, 1.0 - close_fraction(i, i));
  }
  points.push_back({stroke.size() - 1, 0.0});
  return points;
}

}  // namespace

void keep_lines_straight(Stroke& stroke, double tolerance) {
  const std::vector<PointOnLine> points = points_on(stroke, tolerance);
  visit_columns(stroke, [&](const char*, auto& column) {
    if (column.empty()) return;
    std::remove_reference_t<decltype(column)> all;
    for (const auto& [sample, fraction] : points)
      all.push_back(fraction > 0.0 ? between(column[sample], column[sample + 1], fraction) : column[sample]);
    column = std::move(all);
  });
}

}  // namespace sandstroke
