#include "core/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/hash.h"

namespace sandstroke {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

long double wide(double x) { return static_cast<long double>(x); }

/// The distance of the result from `exact`, the same function in long double (64 bits on x86-64, 113 on
/// arm64), in units in the last place: of the nearest double half a unit, and what long double itself is off.
double units_off(double result, long double exact) {
  const double size = std::abs(result), unit = std::nextafter(size, infinity) - size;
  return static_cast<double>(std::abs(wide(result) - exact) / wide(unit));
}
constexpr double nearest = 0.502;

/// The k-th of numbers between `from` and `to`.
double number(int k, double from, double to) {
  return from + (to - from) * unit_hash(static_cast<std::uint64_t>(k));
}
constexpr int numbers_of_each = 20'000;

using One = double (*)(double);
using Long = long double (*)(long double);
struct Case {
  const char* name;
  One function;
  Long exact;
  double from, to;
};

TEST(Elementary, FunctionsOfOneArgumentAreTheNearestDouble) {
  for (const Case& c : {
           Case{"sin", elementary::sin, std::sin, -10.0, 10.0},
           {"sin", elementary::sin, std::sin, -1e6, 1e6},
           {"sin", elementary::sin, std::sin, -1e-3, 1e-3},
           {"cos", elementary::cos, std::cos, -10.0, 10.0},
           {"cos", elementary::cos, std::cos, -1e6, 1e6},
           {"tan", elementary::tan, std::tan, -1.57, 1.57},
           {"asin", elementary::asin, std::asin, -1.0, 1.0},
           {"asin", elementary::asin, std::asin, -1e-5, 1e-5},
           {"acos", elementary::acos, std::acos, -1.0, 1.0},
           {"acos", elementary::acos, std::acos, 0.99999, 1.0},
           {"exp", elementary::exp, std::exp, -700.0, 700.0},
           {"exp", elementary::exp, std::exp, -1e-3, 1e-3},
           {"expm1", elementary::expm1, std::expm1, -60.0, 60.0},
           {"expm1", elementary::expm1, std::expm1, -1.0, 1.0},
           {"expm1", elementary::expm1, std::expm1, -1e-9, 1e-9},
           {"log1p", elementary::log1p, std::log1p, -0.9999, 9.0},
           {"log1p", elementary::log1p, std::log1p, -1e-5, 1e-5},
           {"log1p", elementary::log1p, std::log1p, 0.0, 1e30},
       }) {
    for (int k = 0; k < numbers_of_each; ++k) {
      const double x = number(k, c.from, c.to);
      ASSERT_LE(units_off(c.function(x), c.exact(wide(x))), nearest) << c.name << " of " << x;
    }
  }
}

TEST(Elementary, FunctionsOfTwoArgumentsAreTheNearestDouble) {
  for (int k = 0; k < numbers_of_each; ++k) {
    const double x = number(2 * k, -1.0, 1.0), y = number(2 * k + 1, -1.0, 1.0);
    const double base = x + 2.0, power = 9.0 * y;
    ASSERT_LE(units_off(elementary::atan2(y, x), std::atan2(wide(y), wide(x))), nearest) << y << ", " << x;
    ASSERT_LE(units_off(elementary::pow(base, power), std::pow(wide(base), wide(power))), nearest)
        << base << ", " << power;
  }
}

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

TEST(Elementary, AnglesAreThoseOfTheirQuadrant) {
  using elementary::atan2;
  constexpr double pi = std::numbers::pi;
  EXPECT_EQ(atan2(1.0, 1.0), pi / 4.0);
  EXPECT_EQ(atan2(1.0, -1.0), 3.0 * pi / 4.0);
  EXPECT_EQ(atan2(-1.0, -1.0), -3.0 * pi / 4.0);
  EXPECT_EQ(atan2(-1e-300, -1e300), -pi);
  EXPECT_EQ(atan2(-2.0, 0.0), -pi / 2.0);
  EXPECT_EQ(atan2(0.0, -1.0), pi);
  EXPECT_EQ(atan2(-0.0, -1.0), -pi);
  EXPECT_EQ(atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(atan2(infinity, -infinity), 3.0 * pi / 4.0);
  EXPECT_EQ(atan2(5.0, infinity), 0.0);
  EXPECT_EQ(elementary::asin(-1.0), -pi / 2.0);
  EXPECT_EQ(elementary::acos(1.0), 0.0);
  EXPECT_EQ(elementary::acos(-1.0), pi);
}

TEST(Elementary, FunctionsAreAtTheEdgesWhatTheyAreElsewhere) {
  EXPECT_EQ(elementary::exp(0.0), 1.0);
  EXPECT_EQ(elementary::exp(709.79), infinity);
  EXPECT_EQ(elementary::exp(-infinity), 0.0);
  EXPECT_EQ(elementary::expm1(-infinity), -1.0);
  EXPECT_EQ(elementary::expm1(infinity), infinity);
  EXPECT_EQ(elementary::log1p(infinity), infinity);
  EXPECT_EQ(elementary::log1p(-1.0), -infinity);
  EXPECT_EQ(elementary::pow(7.0, 0.0), 1.0);
  EXPECT_EQ(elementary::pow(2.0, 10.0), 1024.0);
  EXPECT_EQ(elementary::pow(10.0, 400.0), infinity);
  EXPECT_EQ(elementary::pow(10.0, -400.0), 0.0);
  EXPECT_EQ(elementary::sin(0x1p60), elementary::sin(std::fmod(0x1p60, 2.0 * std::numbers::pi)));
  for (const auto function :
       {elementary::sin, elementary::tan, elementary::asin, elementary::expm1, elementary::log1p})
    EXPECT_TRUE(std::signbit(function(-0.0)));
  for (const double wrong : {nan, infinity})
    for (const auto function :
         {elementary::sin, elementary::cos, elementary::tan, elementary::asin, elementary::acos})
      EXPECT_TRUE(std::isnan(function(wrong)));
  for (const auto function : {elementary::exp, elementary::expm1, elementary::log1p})
    EXPECT_TRUE(std::isnan(function(nan)));
  EXPECT_TRUE(std::isnan(elementary::log1p(-2.0)));
  EXPECT_TRUE(std::isnan(elementary::acos(1.5)));
}

}  // namespace
}  // namespace sandstroke
