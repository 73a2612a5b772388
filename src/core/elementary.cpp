#include "core/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/double_double.h"

namespace sandstroke::elementary {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Constants as sums of parts: pi / 2 is exact to 2^-163 and ln 2 to 2^-110.
constexpr std::array half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54, -0x1.f1976b7ed8fbcp-110};
constexpr DoubleDouble pi{2.0 * half_pi[0], 2.0 * half_pi[1]};
constexpr DoubleDouble ln2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

/// 1 / n!, for the series of exp, sin and cos.
constexpr std::array<DoubleDouble, 32> inverse_factorial = [] {
  std::array<DoubleDouble, 32> inverse;
  inverse[0] = 1.0;
  for (int n = 1; n < 32; ++n) inverse[n] = inverse[n - 1] / static_cast<double>(n);
  return inverse;
}();

/// 1 / n, for the series of log and atan.
constexpr std::array<DoubleDouble, 46> inverse = [] {
  std::array<DoubleDouble, 46> inverses;
  for (int n = 1; n < 46; ++n) inverses[n] = DoubleDouble(1.0) / static_cast<double>(n);
  return inverses;
}();

/// r^first / first! - r^(first + 2) / (first + 2)! + ..., for |r| up to about pi / 4. Terms below 2^-20 of
/// the first are plain doubles, which gives 70 bits.
DoubleDouble alternating(const DoubleDouble& r, int first) {
  const int plain_from = first + 10;
  double tail = 0.0;
  for (int n = first + 22; n >= plain_from; n -= 2) tail = inverse_factorial[n].high - r.high * r.high * tail;
  const DoubleDouble square = r * r;
  DoubleDouble sum = tail;
  for (int n = plain_from - 2; n >= first; n -= 2) sum = inverse_factorial[n] - square * sum;
  return first == 1 ? r * sum : sum;
}

/// A finite x as its distance from the nearest multiple of pi / 2, and the number of that multiple modulo 4.
struct Turn {
  DoubleDouble rest;
  int quarters;
};
Turn turn_of(double x) {
  if (std::abs(x) >= 0x1p52) x = std::fmod(x, 2.0 * std::numbers::pi);  // fmod is exact
  const double quarters = std::floor(x / half_pi[0] + 0.5);
  DoubleDouble rest = x;
  for (const double part : half_pi) rest = rest - DoubleDouble::product(quarters, part);
  return {rest, static_cast<int>(quarters - 4.0 * std::floor(quarters / 4.0))};
}

/// The sine of the turn plus `later` times pi / 2.
DoubleDouble sine_of(const Turn& turn, int later = 0) {
  const int quarters = (turn.quarters + later) % 4;
  const DoubleDouble size = alternating(turn.rest, quarters % 2 == 0 ? 1 : 0);
  return quarters < 2 ? size : -size;
}

constexpr int steps_of_two = 32;

/// 2^(j / 32) - 1.
constexpr std::array<DoubleDouble, steps_of_two> part_of_two = [] {
  std::array<DoubleDouble, steps_of_two> parts;
  for (int j = 0; j < steps_of_two; ++j) {
    const DoubleDouble x = ln2 * (static_cast<double>(j) / steps_of_two);
    for (std::size_t n = inverse_factorial.size() - 1; n >= 1; --n)
      parts[j] = x * (parts[j] + inverse_factorial[n]);
  }
  return parts;
}();

/// exp(x) - 1 = 2^power (fraction + 1) - 1, with a fraction from -0.02 to 0.98.
struct Exponential {
  DoubleDouble fraction;
  int power = 0;
};
/// exp(x) - 1 for |x| < 2000. Every tick computes forces with it, so small terms are plain doubles (70 bits).
Exponential exponential(const DoubleDouble& x) {
  const double count = std::floor(x.high * (steps_of_two / ln2.high) + 0.5);
  const DoubleDouble rest = x - ln2 * (count / steps_of_two);
  const double r = rest.high;  // at most 0.011
  double tail = 1.0 / 40320;
  for (const double term : {1.0 / 5040, 1.0 / 720, 1.0 / 120, 1.0 / 24, 1.0 / 6}) tail = term + r * tail;
  const DoubleDouble square = rest * rest, half = {0.5 * square.high, 0.5 * square.low};
  const DoubleDouble grown = rest + (half + r * r * r * tail);  // exp(rest) - 1
  const double power = std::floor(count / steps_of_two);
  const DoubleDouble& part = part_of_two[static_cast<std::size_t>(count - steps_of_two * power)];
  return {part + grown + part * grown, static_cast<int>(power)};
}

/// exp(x) for |x| < 2000; 0 or infinity if it is beyond all doubles.
double exp_of(const DoubleDouble& x) {
  const Exponential e = exponential(x);
  return std::scalbn((e.fraction + 1.0).high, e.power);
}

/// ln(1 + x) for finite x > -1. one_more: 1 + x, given beside x so that neither loses bits.
DoubleDouble log_of(const DoubleDouble& x, const DoubleDouble& one_more) {
  int power = 0;
  if (std::frexp(one_more.high, &power) < std::numbers::sqrt2 / 2.0) --power;
  const DoubleDouble less = power == 0 ? x : scaled(one_more, -power) - 1.0;
  const DoubleDouble s = less / (less + 2.0), square = s * s;  // ln(1 + l) = 2 artanh(l / (2 + l))
  DoubleDouble sum;
  for (int n = 45; n >= 1; n -= 2) sum = inverse[n] + square * sum;
  return ln2 * static_cast<double>(power) + scaled(s * sum, 1);
}

/// The arctangent of t from 0 to 1.
DoubleDouble arctangent(DoubleDouble t) {
  constexpr int halvings = 3;  // of the angle
  for (int i = 0; i < halvings; ++i) t = t / (sqrt(t * t + 1.0) + 1.0);
  const DoubleDouble square = t * t;
  DoubleDouble sum;
  for (int n = 33; n >= 1; n -= 2) sum = inverse[n] - square * sum;
  return scaled(t * sum, halvings);
}

/// The angle of the point (x, y), from 0 to pi. x and y are finite, y >= 0, and one of them is not 0.
double angle_of(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble across = x.high < 0.0 ? -x : x;
  const bool steep = y.high > across.high;
  DoubleDouble angle = arctangent(steep ? across / y : y / across);
  if (steep) angle = scaled(pi, -1) - angle;
  return (x.high < 0.0 ? pi - angle : angle).high;
}

/// sqrt(1 - x^2)
DoubleDouble beside(double x) { return sqrt(DoubleDouble::sum(1.0, -x) * DoubleDouble::sum(1.0, x)); }

}  // namespace

double sin(double x) {
  if (!std::isfinite(x)) return nan;
  return x == 0.0 ? x : sine_of(turn_of(x)).high;
}

double cos(double x) { return std::isfinite(x) ? sine_of(turn_of(x), 1).high : nan; }

double tan(double x) {
  if (!std::isfinite(x)) return nan;
  if (x == 0.0) return x;
  const Turn turn = turn_of(x);
  return (sine_of(turn) / sine_of(turn, 1)).high;
}

double asin(double x) {
  if (!(std::abs(x) <= 1.0)) return nan;
  return x == 0.0 ? x : std::copysign(angle_of(beside(x), std::abs(x)), x);
}

double acos(double x) { return std::abs(x) <= 1.0 ? angle_of(x, beside(x)) : nan; }

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return nan;
  if (std::isinf(x) || std::isinf(y)) {  // along an axis or a diagonal
    y = std::copysign(std::isinf(y) ? 1.0 : 0.0, y);
    x = std::copysign(std::isinf(x) ? 1.0 : 0.0, x);
  }
  if (y == 0.0) return std::signbit(x) ? std::copysign(pi.high, y) : y;
  const int power = -std::ilogb(std::max(std::abs(x), std::abs(y)));
  return std::copysign(angle_of(std::scalbn(x, power), std::scalbn(std::abs(y), power)), y);
}

double exp(double x) {
  if (std::isnan(x)) return nan;
  return exp_of(std::clamp(x, -1000.0, 1000.0));
}

double expm1(double x) {
  if (std::isnan(x)) return nan;
  if (std::abs(x) < 0x1p-54) return x;  // also 0, of either sign
  if (x < -50.0) return -1.0;           // the nearest double
  if (x > 50.0) return exp(x);          // the same double
  const Exponential e = exponential(x);
  const DoubleDouble more = DoubleDouble::sum(1.0, -std::scalbn(1.0, -e.power));
  return std::scalbn((e.fraction + more).high, e.power);
}

double log1p(double x) {
  if (!(x >= -1.0)) return nan;
  if (x == -1.0) return -infinity;
  if (x == infinity || x == 0.0) return x;
  return log_of(x, DoubleDouble::sum(1.0, x)).high;
}

double pow(double x, double y) {
  if (!(x > 0.0) || !std::isfinite(x) || !std::isfinite(y)) return x == 1.0 || y == 0.0 ? 1.0 : nan;
  const DoubleDouble exponent = log_of(DoubleDouble::sum(x, -1.0), x) * y;
  return std::abs(exponent.high) < 1000.0 ? exp_of(exponent) : exp(exponent.high);
}

double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return infinity;
  if (std::isnan(x) || std::isnan(y)) return nan;
  const double larger = std::max(std::abs(x), std::abs(y)), smaller = std::min(std::abs(x), std::abs(y));
  if (smaller <= larger * 0x1p-54) return larger + smaller;
  if (larger > 0x1p511) return 0x1p600 * hypot(x * 0x1p-600, y * 0x1p-600);
  if (smaller < 0x1p-459) return 0x1p-600 * hypot(x * 0x1p600, y * 0x1p600);
  // Borges, An Improved Algorithm for hypot(a, b), arXiv:1904.09481. `excess` is how much the root's square
  // is too large.
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
  if (largest == 0.0) return x + y + z;  // NaN if one of them is NaN
  x /= largest;
  y /= largest;
  z /= largest;
  return largest * std::sqrt(x * x + y * y + z * z);
}

}  // namespace sandstroke::elementary
