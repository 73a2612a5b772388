#include "core/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/hash.h"

namespace sandstroke {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

long double wide(double x) { return static_cast<long double>(x); }

/// How far the result is from `exact`, the same function in long double (64 bits on x86-64, 113 on arm64), in
/// units in the last place: of the nearest double half a unit, and what long double itself is off.
double units_off(double result, long double exact) {
  const double size = std::abs(result), unit = std::nextafter(size, infinity) - size;
  return static_cast<double>(std::abs(wide(result) - exact) / wide(unit));
}

/// The k-th of numbers between `from` and `to`.
double number(int k, double from, double to) {
  return from + (to - from) * unit_hash(static_cast<std::uint64_t>(k));
}
constexpr int numbers_of_each = 20'000;

TEST(Elementary, LengthsAreNearTheirSquaresRoot) {
  for (int k = 0; k < numbers_of_each; ++k) {
    const double x = number(3 * k, -1.0, 1.0), y = number(3 * k + 1, -1.0, 1.0),
                 z = number(3 * k + 2, -1.0, 1.0);
    const long double flat = wide(x) * wide(x) + wide(y) * wide(y);
    ASSERT_LE(units_off(elementary::hypot(x, y), std::sqrt(flat)), 0.57) << x << ", " << y;
    ASSERT_LE(units_off(elementary::hypot(x, y, z), std::sqrt(flat + wide(z) * wide(z))), 2.4)
        << x << ", " << y;
  }
}

TEST(Elementary, LengthsNeitherOverflowNorVanish) {
  EXPECT_EQ(elementary::hypot(3.0, 4.0), 5.0);
  EXPECT_EQ(elementary::hypot(2.0, 3.0, -6.0), 7.0);
  EXPECT_EQ(elementary::hypot(3e300, -4e300), 5e300);
  EXPECT_EQ(elementary::hypot(0x3p-1060, 0x4p-1060), 0x5p-1060);
  EXPECT_EQ(elementary::hypot(1e-200, 1.0), 1.0);
  EXPECT_EQ(elementary::hypot(0.0, -0.0), 0.0);
  EXPECT_EQ(elementary::hypot(-infinity, nan), infinity);
  EXPECT_TRUE(std::isnan(elementary::hypot(1.0, nan)));
}

}  // namespace
}  // namespace sandstroke
