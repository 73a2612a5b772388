#include "core/elementary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandstroke::elementary {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return infinity;
  if (std::isnan(x) || std::isnan(y)) return nan;
  const double larger = std::max(std::abs(x), std::abs(y)), smaller = std::min(std::abs(x), std::abs(y));
  if (smaller <= larger * 0x1p-54) return larger + smaller;
  if (larger > 0x1p511) return 0x1p600 * hypot(x * 0x1p-600, y * 0x1p-600);
  if (smaller < 0x1p-459) return 0x1p-600 * hypot(x * 0x1p600, y * 0x1p600);
  // Borges, An Improved Algorithm for hypot(a, b), arXiv:1904.09481: the root, and what its square is too
  // large by.
  const double root = std::sqrt(larger * larger + smaller * smaller);
  double excess = 0.0;
  if (root <= 2.0 * smaller) {
    const double beyond = root - smaller;
    excess = larger * (2.0 * beyond - larger) + (beyond - 2.0 * (larger - smaller)) * beyond;
  } else {
    const double beyond = root - larger;
    excess = 2.0 * beyond * (larger - 2.0 * smaller) + ((4.0 * beyond - smaller) * smaller + beyond * beyond);
  }
  return root - excess / (2.0 * root);
}

double hypot(double x, double y, double z) {
  if (std::isinf(x) || std::isinf(y) || std::isinf(z)) return infinity;
  const double largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
  if (largest == 0.0) return x + y + z;  // not a number, where one is
  x /= largest, y /= largest, z /= largest;
  return largest * std::sqrt(x * x + y * y + z * z);
}

}  // namespace sandstroke::elementary
