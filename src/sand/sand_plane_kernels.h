#pragma once

#include <Eigen/Core>

namespace sandstroke {

constexpr int plane_places = 48;  // on three circles

/// Sand that was looked at around a tool.
struct SeenSand {
  alignas(64) double x[plane_places], y[plane_places];  ///< reaches from the axis
  alignas(64) double height[plane_places];              ///< m; 0 where there is none
  alignas(64) double there[plane_places];               ///< 1, or 0 where there is none
};

/// a, b, c [m] of a + b x + c y: the plane from which the sand deviates least in sum, about, by four turns of
/// weighted least squares; a deviation counts as reach / 10^4 [m] at least. Vector code (Highway), the same
/// bits for every instruction set.
Eigen::Vector3d least_deviations(const SeenSand& sand, double reach);

}  // namespace sandstroke
