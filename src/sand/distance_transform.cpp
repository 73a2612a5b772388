#include "sand/distance_transform.h"

#include <cmath>
#include <limits>

namespace sandstroke {
namespace {

constexpr double nowhere = 1e15;  // squared samples: whole, and larger than any

/// min over q of (p - q)^2 + f(q), for each p of a line of `count` numbers `step` apart: the lower envelope
/// of parabolas.
void nearest_along(double* f, int count, std::ptrdiff_t step, std::vector<int>& apex,
                   std::vector<double>& from, std::vector<double>& result) {
  const auto value = [&](int q) { return f[q * step]; };
  int last = 0;
  apex[0] = 0;
  from[0] = -std::numeric_limits<double>::infinity();
  for (int q = 1; q < count; ++q) {
    const auto meets = [&](int other) {
      return ((value(q) + static_cast<double>(q) * q) - (value(other) + static_cast<double>(other) * other)) /
             (2.0 * (q - other));
    };
    double place = meets(apex[static_cast<std::size_t>(last)]);
    while (place <= from[static_cast<std::size_t>(last)])
      place = meets(apex[static_cast<std::size_t>(--last)]);
    ++last;
    apex[static_cast<std::size_t>(last)] = q;
    from[static_cast<std::size_t>(last)] = place;
  }
  int at = 0;
  for (int p = 0; p < count; ++p) {
    while (at < last && from[static_cast<std::size_t>(at) + 1] < p) ++at;
    const double way = p - apex[static_cast<std::size_t>(at)];
    result[static_cast<std::size_t>(p)] = way * way + value(apex[static_cast<std::size_t>(at)]);
  }
  for (int p = 0; p < count; ++p) f[p * step] = result[static_cast<std::size_t>(p)];
}

/// Squared distances to the nearest sample that is `sought`.
std::vector<double> squared_distance(const std::vector<unsigned char>& covered, unsigned char sought,
                                     int rows, int cols) {
  std::vector<double> squared(covered.size());
  for (std::size_t i = 0; i < covered.size(); ++i) squared[i] = covered[i] == sought ? 0.0 : nowhere;
  const auto longest = static_cast<std::size_t>(std::max(rows, cols));
  std::vector<int> apex(longest);
  std::vector<double> from(longest + 1), result(longest);
  for (int col = 0; col < cols; ++col) nearest_along(squared.data() + col, rows, cols, apex, from, result);
  for (int row = 0; row < rows; ++row)
    nearest_along(squared.data() + static_cast<std::ptrdiff_t>(row) * cols, cols, 1, apex, from, result);
  return squared;
}

}  // namespace

std::vector<double> signed_distance(const std::vector<unsigned char>& covered, int rows, int cols) {
  std::vector<double> inside = squared_distance(covered, 0, rows, cols);
  const std::vector<double> outside = squared_distance(covered, 1, rows, cols);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const double distance = covered[i] ? std::sqrt(inside[i]) - 0.5 : 0.5 - std::sqrt(outside[i]);
    inside[i] = std::round(distance * 0x1p20) * 0x1p-20;
  }
  return inside;
}

}  // namespace sandstroke
