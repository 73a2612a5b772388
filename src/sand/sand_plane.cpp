#include "sand/sand_plane.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <limits>

#include "core/elementary.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr int per_circle = 32;
constexpr std::array<double, 3> circles = {1.5, 2.0, 2.5};
constexpr int least_places = 8;

const std::array<Eigen::Vector2d, per_circle>& directions() {
  static const std::array<Eigen::Vector2d, per_circle> all = [] {
    std::array<Eigen::Vector2d, per_circle> made;
    for (int i = 0; i < per_circle; ++i) {
      const double angle = 2.0 * 3.141592653589793 * (i + 0.5) / per_circle;
      made[static_cast<std::size_t>(i)] = {elementary::cos(angle), elementary::sin(angle)};
    }
    return made;
  }();
  return all;
}

}  // namespace

SandPlane fit_sand_plane(const HeightField& bed, double x, double y, double reach) {
  std::array<Vector3d, circles.size() * per_circle> places;  // 1, x and y from the axis [reaches]
  std::array<double, circles.size() * per_circle> heights;
  std::size_t count = 0;
  for (const double circle : circles)
    for (const Eigen::Vector2d& direction : directions()) {
      const Eigen::Vector2d at = circle * direction;
      const double height = bed.height_at(x + reach * at.x(), y + reach * at.y());
      if (std::isnan(height)) continue;
      places[count] = {1.0, at.x(), at.y()};
      heights[count++] = height;
    }
  if (count < least_places) return {bed.height_at(x, y)};
  Vector3d plane = Vector3d::Zero();
  for (int turn = 0; turn < 6; ++turn) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const double off = std::abs(heights[i] - places[i].dot(plane));
      const double weight = turn == 0 ? 1.0 : 1.0 / (off + 1e-4 * reach);
      normal += weight * places[i] * places[i].transpose();
      right += weight * heights[i] * places[i];
    }
    // Where the places lie on one side (beside the bed's edge) slopes stay determined: circles are no line.
    plane = normal.ldlt().solve(right);
  }
  return {plane[0], plane.tail<2>() / reach};
}

}  // namespace sandstroke
