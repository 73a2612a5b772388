#include "sand/sand_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sand/initial_surface.h"

namespace sandstroke {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Calls visit(from, to) for each edge of a polygon.
template <class Visit>
void visit_edges(const Points& points, const Visit& visit) {
  for (std::size_t i = 0; i < points.size(); ++i) visit(points[i], points[(i + 1) % points.size()]);
}

bool is_inside(const Points& points, const Eigen::Vector2d& at) {
  bool inside = false;
  visit_edges(points, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    if ((a.y() > at.y()) == (b.y() > at.y())) return;
    if (at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  });
  return inside;
}

double distance_from_edges(const Points& points, const Eigen::Vector2d& at) {
  double least = std::numeric_limits<double>::infinity();
  visit_edges(points, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d along = b - a, way = at - a;
    const double length = along.squaredNorm();
    const double t = length > 0.0 ? std::clamp(way.dot(along) / length, 0.0, 1.0) : 0.0;
    least = std::min(least, (way - t * along).squaredNorm());
  });
  return std::sqrt(least);
}

/// The part of a polygon where sign * coordinate <= sign * limit (Sutherland and Hodgman 1974). A polygon
/// that is not convex may keep edges along the limit, which enclose nothing.
Points cut(const Points& points, int axis, double limit, double sign) {
  Points kept;
  visit_edges(points, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const double from = sign * (limit - a[axis]), to = sign * (limit - b[axis]);
    if (from >= 0.0) kept.push_back(a);
    if ((from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0))
      kept.push_back(a + from / (from - to) * (b - a));
  });
  return kept;
}

double polygon_area(const Points& points, const Eigen::Vector2d& about) {
  double twice = 0.0;
  visit_edges(points, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    twice += cross(a - about, b - about);
  });
  return 0.5 * std::abs(twice);
}

}  // namespace

RegionArea::RegionArea(const SandRegion& region) : region_(region) {}

double RegionArea::depth_inside(const Eigen::Vector2d& at) const {
  switch (region_.shape) {
    case RegionShape::rectangle: {
      const Eigen::Vector2d beyond = (at - region_.centre).cwiseAbs() - 0.5 * region_.size;
      return -beyond.cwiseMax(0.0).norm() - std::min(beyond.maxCoeff(), 0.0);
    }
    case RegionShape::circle:
      return region_.radius - (at - region_.centre).norm();
    case RegionShape::polygon:
      break;
  }
  const double distance = distance_from_edges(region_.points, at);
  return is_inside(region_.points, at) ? distance : -distance;
}

double RegionArea::share(const Eigen::Vector2d& at) const {
  const double depth = depth_inside(at);
  if (region_.soft == 0.0) return depth >= 0.0 ? 1.0 : 0.0;
  return std::clamp(0.5 + depth / region_.soft, 0.0, 1.0);
}

double RegionArea::whole_share(const Eigen::Vector2d& centre, double side) const {
  // No place of the square is nearer to the edge than its centre by more than half a diagonal.
  const double depth = depth_inside(centre), reach = 0.5 * (region_.soft + std::numbers::sqrt2 * side);
  if (std::abs(depth) < reach) return 0.5;
  return depth > 0.0 ? 1.0 : 0.0;
}

double RegionArea::sharp_area(const Eigen::AlignedBox2d& square) const {
  switch (region_.shape) {
    case RegionShape::rectangle:
      return square.intersection({region_.centre - 0.5 * region_.size, region_.centre + 0.5 * region_.size})
          .sizes()
          .cwiseMax(0.0)
          .prod();
    case RegionShape::circle: {
      const Eigen::Vector2d low = square.min() - region_.centre, high = square.max() - region_.centre;
      return disk_rectangle_area(region_.radius, low.x(), high.x(), low.y(), high.y());
    }
    case RegionShape::polygon:
      break;
  }
  Points part = region_.points;
  for (const int axis : {0, 1}) {
    part = cut(part, axis, square.max()[axis], 1.0);
    part = cut(part, axis, square.min()[axis], -1.0);
  }
  return polygon_area(part, square.center());
}

double RegionArea::mean_share(const Eigen::Vector2d& centre, double side) const {
  if (const double whole = whole_share(centre, side); whole == 0.0 || whole == 1.0) return whole;
  if (region_.soft == 0.0) {
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * side);
    return std::clamp(sharp_area({centre - half, centre + half}) / (side * side), 0.0, 1.0);
  }
  constexpr int samples = 8;
  double sum = 0.0;
  visit_samples(centre, side, samples, [&](const Eigen::Vector2d& at) { sum += share(at); });
  return sum / (samples * samples);
}

Eigen::AlignedBox2d RegionArea::bounds() const {
  Eigen::AlignedBox2d box;
  if (region_.shape == RegionShape::polygon) {
    for (const Eigen::Vector2d& point : region_.points) box.extend(point);
  } else {
    const Eigen::Vector2d half = region_.shape == RegionShape::circle
                                     ? Eigen::Vector2d::Constant(region_.radius)
                                     : Eigen::Vector2d(0.5 * region_.size);
    box = {region_.centre - half, region_.centre + half};
  }
  const Eigen::Vector2d beyond = Eigen::Vector2d::Constant(0.5 * region_.soft);
  return {box.min() - beyond, box.max() + beyond};
}

bool crosses_itself(const Points& points) {
  const auto side = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return cross(b - a, c - a);
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = i + 2; k < points.size(); ++k) {
      const Eigen::Vector2d &a = points[i], &b = points[i + 1], &c = points[k],
                            &d = points[(k + 1) % points.size()];
      if (side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0) return true;
    }
  return false;
}

}  // namespace sandstroke
