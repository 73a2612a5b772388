#pragma once

#include <Eigen/Core>

namespace sandstroke {

constexpr int plane_samples = 48;  // on three circles

/// Samples of the sand around a tool.
struct SeenSand {
  alignas(64) double x[plane_samples], y[plane_samples];  ///< from the axis, in reaches
  alignas(64) double height[plane_samples];               ///< m; 0 where there is none
  alignas(64) double there[plane_samples];                ///< 1, or 0 where there is none
};

/// Returns a, b, c [m] of the plane a + b x + c y that has about the least sum of deviations from the sand,
/// by four rounds of weighted least squares. A deviation counts as at least reach / 10^4 [m]. Vector code
/// (Highway), the same bits for every instruction set.
Eigen::Vector3d least_deviations(const SeenSand& sand, double reach);

}  // namespace sandstroke
