#include "sand/sand_plane.h"

#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "sand/sand_plane_kernels.h"

namespace sandstroke {
namespace {

/// The places where the sand is sampled, without heights.
SeenSand all_places() {
  constexpr int per_circle = 16;
  SeenSand places{};
  for (int i = 0; i < plane_places; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % per_circle + 0.5) / per_circle;
    const double circle = 1.5 + 0.5 * (i / per_circle);
    places.x[i] = circle * elementary::cos(angle);
    places.y[i] = circle * elementary::sin(angle);
  }
  return places;
}

}  // namespace

SandPlane fit_sand_plane(const HeightField& bed, double x, double y, double reach) {
  static const SeenSand places = all_places();
  constexpr int least_places = 8;
  SeenSand sand = places;
  int count = 0;
  for (int i = 0; i < plane_places; ++i) {
    const double height = bed.height_at(x + reach * places.x[i], y + reach * places.y[i]);
    const bool there = !std::isnan(height);
    sand.height[i] = there ? height : 0.0;
    sand.there[i] = there;
    count += there;
  }
  if (count < least_places) return {bed.height_at(x, y)};
  const Eigen::Vector3d plane = least_deviations(sand, reach);
  return {plane[0], plane.tail<2>() / reach};
}

}  // namespace sandstroke
