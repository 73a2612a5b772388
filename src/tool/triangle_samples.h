#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace sandstroke {

/// Calls visit(x, y, z) for the points of the lattice of whole numbers that a triangle covers, seen from
/// above; its edges count. x and y in steps of the lattice, of which a metre has `per_metre`; z [m]. Nothing
/// is covered by an upright triangle: its neighbours cover its edges.
template <class Visit>
void visit_triangle_samples(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                            double per_metre, const Visit& visit) {
  using Eigen::Vector2d;
  const auto cross = [](const Vector2d& p, const Vector2d& q) { return p.x() * q.y() - p.y() * q.x(); };
  const auto in_steps = [&](const Eigen::Vector3d& p) {
    return Vector2d(per_metre * p.x(), per_metre * p.y());
  };
  const Vector2d A = in_steps(a), B = in_steps(b), C = in_steps(c);
  const double area = cross(B - A, C - A);
  if (std::abs(area) < 1e-9) return;
  const double slack = -1e-9 * std::abs(area), low_z = std::min({a.z(), b.z(), c.z()}),
               high_z = std::max({a.z(), b.z(), c.z()});
  const Vector2d low = A.cwiseMin(B).cwiseMin(C), high = A.cwiseMax(B).cwiseMax(C);
  for (int y = static_cast<int>(std::ceil(low.y() - 1e-9)); y <= std::floor(high.y() + 1e-9); ++y)
    for (int x = static_cast<int>(std::ceil(low.x() - 1e-9)); x <= std::floor(high.x() + 1e-9); ++x) {
      const Vector2d P(x, y);
      const double u = cross(C - B, P - B), v = cross(A - C, P - C), w = cross(B - A, P - A);
      const double sign = area > 0.0 ? 1.0 : -1.0;
      if (sign * u < slack || sign * v < slack || sign * w < slack) continue;
      visit(x, y, std::clamp((u * a.z() + v * b.z() + w * c.z()) / area, low_z, high_z));
    }
}

}  // namespace sandstroke
