#pragma once

#include <cmath>

namespace sandstroke {

inline double mean(double a, double b) { return 0.5 * (a + b); }
/// Of positive numbers.
inline double geometric_mean(double a, double b) { return std::sqrt(a * b); }

/// Where a condition stops to hold, between low, where it holds, and high, where it does not: halves what is
/// between them so many times, at middle(low, high).
template <class Middle, class Condition>
double boundary_between(double low, double high, int halvings, const Middle& middle, const Condition& holds) {
  for (; halvings > 0; --halvings) {
    const double between = middle(low, high);
    (holds(between) ? low : high) = between;
  }
  return middle(low, high);
}

}  // namespace sandstroke
