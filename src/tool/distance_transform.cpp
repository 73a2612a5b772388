#include "tool/distance_transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandstroke {
namespace {

constexpr double far_away = 1e7;  // samples: a whole number, larger than any distance

/// min over q of (p - q)^2 + f(q), for each p of a line of `count` numbers: the lower envelope of parabolas.
void nearest_along(double* f, int count, std::vector<int>& apex, std::vector<double>& from,
                   std::vector<double>& result) {
  const auto value = [&](int q) { return f[q]; };
  int last = 0;
  apex[0] = 0;
  from[0] = -std::numeric_limits<double>::infinity();
  for (int q = 1; q < count; ++q) {
    const auto meets = [&](int other) {
      return ((value(q) + static_cast<double>(q) * q) - (value(other) + static_cast<double>(other) * other)) /
             (2.0 * (q - other));
    };
    double meeting = meets(apex[static_cast<std::size_t>(last)]);
    while (meeting <= from[static_cast<std::size_t>(last)])
      meeting = meets(apex[static_cast<std::size_t>(--last)]);
    ++last;
    apex[static_cast<std::size_t>(last)] = q;
    from[static_cast<std::size_t>(last)] = meeting;
  }
  int at = 0;
  for (int p = 0; p < count; ++p) {
    while (at < last && from[static_cast<std::size_t>(at) + 1] < p) ++at;
    const double way = p - apex[static_cast<std::size_t>(at)];
    result[static_cast<std::size_t>(p)] = way * way + value(apex[static_cast<std::size_t>(at)]);
  }
  std::copy_n(result.begin(), count, f);
}

/// Squared distances to the nearest sample that is `sought`.
std::vector<double> squared_distance(const std::vector<unsigned char>& covered, unsigned char sought,
                                     int rows, int cols) {
  // Along columns by two sweeps; then along rows.
  std::vector<double> squared(covered.size());
  const auto width = static_cast<std::size_t>(cols), length = static_cast<std::size_t>(rows);
  for (std::size_t i = 0; i < covered.size(); ++i)
    squared[i] = covered[i] == sought ? 0.0 : i < width ? far_away : squared[i - width] + 1.0;
  for (std::size_t i = (length - 1) * width; i-- > 0;)
    squared[i] = std::min(squared[i], squared[i + width] + 1.0);
  for (double& distance : squared) distance *= distance;
  std::vector<int> apex(width);
  std::vector<double> from(width + 1), result(width);
  for (std::size_t row = 0; row < length; ++row)
    nearest_along(squared.data() + row * width, cols, apex, from, result);
  return squared;
}

double rounded(double distance) { return std::round(distance * 0x1p20) * 0x1p-20; }

}  // namespace

std::vector<double> distance_inside(const std::vector<unsigned char>& covered, int rows, int cols) {
  std::vector<double> inside = squared_distance(covered, 0, rows, cols);
  for (double& squared : inside) squared = squared > 0.0 ? rounded(std::sqrt(squared) - 0.5) : 0.0;
  return inside;
}

std::vector<double> signed_distance(const std::vector<unsigned char>& covered, int rows, int cols) {
  std::vector<double> inside = squared_distance(covered, 0, rows, cols);
  const std::vector<double> outside = squared_distance(covered, 1, rows, cols);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    inside[i] = rounded(covered[i] ? std::sqrt(inside[i]) - 0.5 : 0.5 - std::sqrt(outside[i]));
  }
  return inside;
}

}  // namespace sandstroke
