#include "sand/sand_plane.h"

#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "sand/sand_plane_kernels.h"

namespace sandstroke {
namespace {

/// The positions where the sand is sampled, without heights.
SeenSand sample_positions() {
  constexpr int per_circle = 16;
  SeenSand positions{};
  for (int i = 0; i < plane_samples; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % per_circle + 0.5) / per_circle;
    const double circle = 1.5 + 0.5 * (i / per_circle);
    positions.x[i] = circle * elementary::cos(angle);
    positions.y[i] = circle * elementary::sin(angle);
  }
  return positions;
}

}  // namespace

SandPlane fit_sand_plane(const HeightField& bed, double x, double y, double reach) {
  static const SeenSand positions = sample_positions();
  constexpr int least_samples = 8;
  SeenSand sand = positions;
  int count = 0;
  for (int i = 0; i < plane_samples; ++i) {
    const double height = bed.height_at(x + reach * positions.x[i], y + reach * positions.y[i]);
    const bool there = !std::isnan(height);
    sand.height[i] = there ? height : 0.0;
    sand.there[i] = there;
    count += there;
  }
  if (count < least_samples) return {bed.height_at(x, y)};
  const Eigen::Vector3d plane = least_deviations(sand, reach);
  return {plane[0], plane.tail<2>() / reach};
}

}  // namespace sandstroke
