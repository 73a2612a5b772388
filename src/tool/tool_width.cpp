#include "tool/tool_width.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "core/disjoint_sets.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross_of(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The corners of the convex hull, counterclockwise (Andrew's monotone chain).
std::vector<Vector2d> hull_of(std::vector<Vector2d> points) {
  const auto before = [](const Vector2d& a, const Vector2d& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  };
  std::sort(points.begin(), points.end(), before);
  std::vector<Vector2d> hull;
  for (const bool upper : {false, true}) {
    const std::size_t first = hull.size();
    for (const Vector2d& point : points) {
      while (hull.size() >= first + 2 &&
             cross_of(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();  // it begins the other half
    if (!upper) std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// The least distance of two parallel lines that have the points between them.
double width_between_lines(std::vector<Vector2d> points) {
  const std::vector<Vector2d> hull = hull_of(std::move(points));
  if (hull.size() < 3) return 0.0;
  double width = std::numeric_limits<double>::infinity();
  std::size_t opposite = 1;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d side = hull[(i + 1) % hull.size()] - hull[i];
    const auto away = [&](std::size_t k) { return cross_of(side, hull[k % hull.size()] - hull[i]); };
    while (away(opposite + 1) > away(opposite)) ++opposite;
    width = std::min(width, away(opposite) / side.norm());
  }
  return width;
}

/// The outlines in which a level plane cuts a closed surface.
class Cut {
 public:
  Cut(const TriangleMesh& surface, double height) : surface_(surface), height_(height) {
    for (const auto& corners : surface.triangles) add(corners);
  }
  bool empty() const { return points_.empty(); }

  double narrowest() {
    std::map<std::size_t, std::vector<Vector2d>> outlines;
    for (std::size_t i = 0; i < points_.size(); ++i) outlines[outlines_.root(i)].push_back(points_[i]);
    double width = std::numeric_limits<double>::infinity();
    for (auto& [first, outline] : outlines) width = std::min(width, width_between_lines(std::move(outline)));
    // Four areas by the perimeter: the diameter of a circle, the side of a square, and twice the width of a
    // thin wall, however bent.
    return perimeter_ > 0.0 ? std::min(width, 4.0 * area_ / perimeter_) : 0.0;
  }

 private:
  bool is_above(std::int32_t vertex) const {
    return surface_.vertices[static_cast<std::size_t>(vertex)].z() > height_;
  }

  void add(const std::array<std::int32_t, 3>& corners) {
    // The outline goes from the edge that runs down to the one that runs up: then the solid lies left of it.
    std::size_t down = 0, up = 0;
    int crossed = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t from = corners[i], to = corners[(i + 1) % 3];
      if (is_above(from) == is_above(to)) continue;
      ++crossed;
      (is_above(from) ? down : up) = point_on(from, to);
    }
    if (crossed == 0) return;
    outlines_.join(down, up);
    const Vector2d &a = points_[down], &b = points_[up];
    area_ += 0.5 * cross_of(a - points_.front(), b - points_.front());
    perimeter_ += (b - a).norm();
  }

  std::size_t point_on(std::int32_t from, std::int32_t to) {
    const std::pair edge = std::minmax(from, to);
    const auto [entry, is_new] = at_.try_emplace({edge.first, edge.second}, points_.size());
    if (is_new) {
      const Vector3d &a = surface_.vertices[static_cast<std::size_t>(edge.first)],
                     &b = surface_.vertices[static_cast<std::size_t>(edge.second)];
      const double part = (height_ - a.z()) / (b.z() - a.z());
      points_.emplace_back((a + part * (b - a)).head<2>());
      outlines_.add();
    }
    return entry->second;
  }

  const TriangleMesh& surface_;
  double height_, area_ = 0.0, perimeter_ = 0.0;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> at_;  // the point on an edge
  std::vector<Vector2d> points_;
  DisjointSets outlines_;  // of the points
};

}  // namespace

double narrowest_width(const TriangleMesh& surface, double depth) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Vector3d& vertex : surface.vertices) {
    lowest = std::min(lowest, vertex.z());
    highest = std::max(highest, vertex.z());
  }
  constexpr int planes = 8;
  const double up_to = std::min(depth, highest - lowest);
  double width = 0.0;
  for (int i = 1; i <= planes; ++i) {
    // The last plane of a whole tool lies just below its top.
    Cut cut(surface, lowest + up_to * (i - (i == planes ? 1e-6 : 0.0)) / planes);
    if (!cut.empty()) width = std::max(width, cut.narrowest());
  }
  return width;
}

double narrowest_width(const ToolSettings& tool, double depth) {
  if (tool.shape == ToolShape::sphere || tool.shape == ToolShape::rake) return 2.0 * tool.radius;
  return narrowest_width(turned(tool_surface(tool), own_rotation(tool)), depth);
}

}  // namespace sandstroke
