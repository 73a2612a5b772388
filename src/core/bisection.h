#pragma once

#include <cmath>
#include <limits>

namespace sandstroke {

inline double mean(double a, double b) { return 0.5 * (a + b); }
/// Both numbers must be positive.
inline double geometric_mean(double a, double b) { return std::sqrt(a * b); }

/// The point between low, where the condition holds, and high, where it does not, at which it stops to hold.
/// Halves the interval `halvings` times, at middle(low, high).
template <class Middle, class Condition>
double boundary_between(double low, double high, int halvings, const Middle& middle, const Condition& holds) {
  for (; halvings > 0; --halvings) {
    const double between = middle(low, high);
    if (holds(between))
      low = between;
    else
      high = between;
  }
  return middle(low, high);
}

/// The positive number up to which a condition holds, to 1 in 10^7. Infinity if it holds up to 1e12, 0 if it
/// does not hold at 1e-12.
template <class Condition>
double boundary_of_positive(const Condition& holds) {
  double low = 1.0, high = 1.0;
  while (!holds(low))
    if ((low *= 0.5) < 1e-12) return 0.0;
  while (holds(high))
    if ((high *= 2.0) > 1e12) return std::numeric_limits<double>::infinity();
  return boundary_between(low, high, 24, geometric_mean, holds);
}

}  // namespace sandstroke
