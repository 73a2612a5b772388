#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandstroke {

/// Underside of the sphere: the paper's filter a sin(rho^2/s^2), or the sphere itself.
enum class ToolProfile { paper, sphere };

/// The paper's filter f(u) = sin(u) - 0.53 with u = (rho/s)^2, rho being the distance from the tool's axis
/// (section 3.1, figure 2). It is negative up to u0 = asin(0.53), under the tool, and positive from there to
/// u1, on the ring around it. At u1 its integral over the plane vanishes: 1 - cos(u1) = 0.53 u1.
namespace filter {
inline constexpr double offset = 0.53;
inline constexpr double u0 = 0.5586005653428008;
inline constexpr double u1 = 1.195907635584353;

/// u of a cell whose centre lies rho2 [m^2] from the axis, squared. s is such that u = u0 at the tool's
/// radius [m].
inline double u_of(double rho2, double radius) { return rho2 / (radius * radius / u0); }

/// sin(u) for u <= u1 by its series, to the last bit as the kernels take it.
inline double sine(double u) {
  double sum = 0.0, factorial = 355687428096000.0;  // 17!
  for (int k = 17; k >= 3; k -= 2) {
    sum = sum * (u * u) + (k % 4 == 1 ? 1.0 : -1.0) / factorial;
    factorial /= k * (k - 1);
  }
  return u + u * (u * u * sum);
}

/// Whether a cell lies under the tool: there the filter is negative, and sand is taken out.
inline bool is_negative(double u) { return u <= u0; }

/// The positive filter. The ring takes the sand in proportion to it; it is 0 outside the ring.
inline double positive(double u) { return u > u0 && u <= u1 ? std::max(sine(u) - offset, 0.0) : 0.0; }

/// The tool's underside above its tip [m]; infinite where the tool is not. paper: R sin(u) / (2 u0), which
/// has the sphere's curvature at the tip.
inline double underside(ToolProfile profile, double radius, double rho2) {
  const double u = u_of(rho2, radius);
  if (!is_negative(u)) return std::numeric_limits<double>::infinity();
  if (profile == ToolProfile::paper) return radius / (2.0 * u0) * sine(u);
  return radius - std::sqrt(std::max(radius * radius - rho2, 0.0));
}

/// How far the ring reaches from the axis [m]: s sqrt(u1).
inline double reach(double radius) { return radius * std::sqrt(u1 / u0); }
}  // namespace filter

}  // namespace sandstroke
