#pragma once

#include <cmath>

namespace sandstroke {

/// A number as the sum of two doubles; the second is at most half a unit in the last place of the first. It
/// has 106 bits. It needs only + - * / and sqrt, which every machine rounds alike (Dekker, Numer. Math. 18,
/// 1971; Shewchuk, 1997). No part may be near the largest double.
struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double x) : high(x) {}
  constexpr DoubleDouble(double h, double l) : high(h), low(l) {}

  /// a + b without error, where |a| >= |b| or a is 0.
  static constexpr DoubleDouble ordered_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
  }
  /// a + b without error.
  static constexpr DoubleDouble sum(double a, double b) {
    const double sum = a + b, from_b = sum - a;
    return {sum, (a - (sum - from_b)) + (b - from_b)};
  }
  /// a b without error: splits a and b into halves, whose products are exact.
  static constexpr DoubleDouble product(double a, double b) {
    constexpr double splitter = 0x1p27 + 1.0;
    const double a_high = splitter * a - (splitter * a - a), a_low = a - a_high;
    const double b_high = splitter * b - (splitter * b - b), b_low = b - b_high;
    const double product = a * b;
    return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
  }

  friend constexpr DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
  friend constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble most = sum(a.high, b.high), rest = sum(a.low, b.low);
    const DoubleDouble nearly = ordered_sum(most.high, most.low + rest.high);
    return ordered_sum(nearly.high, nearly.low + rest.low);
  }
  friend constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble most = product(a.high, b.high);
    return ordered_sum(most.high, most.low + (a.high * b.low + a.low * b.high));
  }
  friend constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high / b.high;
    const DoubleDouble rest = a - b * first;
    const double second = rest.high / b.high;
    return ordered_sum(first, second) + (rest - b * second).high / b.high;
  }
};

/// The square root of x >= 0.
inline DoubleDouble sqrt(const DoubleDouble& x) {
  const double root = std::sqrt(x.high);
  if (root == 0.0) return root;
  return DoubleDouble::ordered_sum(root, (x - DoubleDouble::product(root, root)).high / (2.0 * root));
}

/// x 2^power, without error.
inline DoubleDouble scaled(const DoubleDouble& x, int power) {
  return {std::scalbn(x.high, power), std::scalbn(x.low, power)};
}

}  // namespace sandstroke
