#pragma once

#include <cmath>

namespace sandstroke {

/// Where a condition stops to hold, between low > 0, where it holds, and high, where it does not; by
/// bisection of their ratio to 1 + precision.
template <class Condition>
double boundary_between(double low, double high, double precision, const Condition& holds) {
  while (high / low > 1.0 + precision) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

}  // namespace sandstroke
