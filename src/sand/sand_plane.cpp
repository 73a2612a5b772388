#include "sand/sand_plane.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/elementary.h"

namespace sandstroke {
namespace {

constexpr std::size_t per_circle = 16, place_count = 3 * per_circle, least_places = 8;
constexpr int turns = 4;

/// The places, in reaches from the axis.
const std::array<Eigen::Vector2d, place_count>& all_places() {
  static const std::array<Eigen::Vector2d, place_count> all = [] {
    std::array<Eigen::Vector2d, place_count> made;
    for (std::size_t i = 0; i < place_count; ++i) {
      const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i % per_circle) + 0.5) / per_circle;
      const double circle = 1.5 + 0.5 * static_cast<double>(i / per_circle);
      made[i] = circle * Eigen::Vector2d(elementary::cos(angle), elementary::sin(angle));
    }
    return made;
  }();
  return all;
}

}  // namespace

SandPlane fit_sand_plane(const HeightField& bed, double x, double y, double reach) {
  std::array<Eigen::Vector2d, place_count> places;
  std::array<double, place_count> heights;
  std::size_t count = 0;
  for (const Eigen::Vector2d& place : all_places()) {
    const double height = bed.height_at(x + reach * place.x(), y + reach * place.y());
    if (std::isnan(height)) continue;
    places[count] = place;
    heights[count++] = height;
  }
  if (count < least_places) return {bed.height_at(x, y)};
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();  // a, b, c of a + b x + c y
  for (int turn = 0; turn < turns; ++turn) {
    double w = 0.0, wx = 0.0, wy = 0.0, wxx = 0.0, wxy = 0.0, wyy = 0.0, wz = 0.0, wxz = 0.0, wyz = 0.0,
           most_off = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double px = places[i].x(), py = places[i].y(), z = heights[i];
      const double off = std::abs(z - (plane[0] + px * plane[1] + py * plane[2]));
      const double weight = turn == 0 ? 1.0 : 1.0 / (off + 1e-4 * reach);
      most_off = std::max(most_off, off);
      w += weight, wx += weight * px, wy += weight * py, wz += weight * z;
      wxx += weight * px * px, wxy += weight * px * py, wyy += weight * py * py;
      wxz += weight * px * z, wyz += weight * py * z;
    }
    if (turn > 0 && most_off < 1e-6 * reach) break;  // all lie in it
    const Eigen::Matrix3d normal{{w, wx, wy}, {wx, wxx, wxy}, {wy, wxy, wyy}};
    plane = normal.inverse() * Eigen::Vector3d(wz, wxz, wyz);
  }
  return {plane[0], plane.tail<2>() / reach};
}

}  // namespace sandstroke
