#include "tool/mesh_overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace sandstroke {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

using Corners = std::array<Vector3d, 3>;

/// How far one of two triangles must move along a direction of any length until they are parted [m]: negative
/// if they lie apart; none if the direction is no direction.
std::optional<double> overlap_along(const Vector3d& direction, const Corners& a, const Corners& b) {
  const double length = direction.norm();
  if (!(length > 0.0)) return std::nullopt;
  const auto range = [&](const Corners& corners) {
    const double x = direction.dot(corners[0]), y = direction.dot(corners[1]), z = direction.dot(corners[2]);
    return std::pair(std::min({x, y, z}), std::max({x, y, z}));
  };
  const auto [low_a, high_a] = range(a);
  const auto [low_b, high_b] = range(b);
  return std::min(high_a - low_b, high_b - low_a) / length;
}

/// Whether no direction parts two triangles that move by less than `tolerance` (the theorem of the separating
/// axis).
bool overlap(const Corners& a, const Corners& b, double tolerance) {
  const Vector3d sides_a[] = {a[1] - a[0], a[2] - a[1], a[0] - a[2]},
                 sides_b[] = {b[1] - b[0], b[2] - b[1], b[0] - b[2]};
  Vector3d normal_a = sides_a[0].cross(sides_a[1]), normal_b = sides_b[0].cross(sides_b[1]);
  const auto is_needle = [&](const Vector3d& normal, const Vector3d(&sides)[3]) {
    return normal.norm() <= tolerance * std::max({sides[0].norm(), sides[1].norm(), sides[2].norm()});
  };
  if (is_needle(normal_a, sides_a) || is_needle(normal_b, sides_b)) return false;
  normal_a.normalize();
  normal_b.normalize();
  const auto parts = [&](const Vector3d& direction) {
    const std::optional<double> along = overlap_along(direction, a, b);
    return along && *along < tolerance;
  };
  // In one plane, as far as corners can tell, only lines in that plane part them.
  const auto in_plane = [&](const Corners& corners, const Vector3d& normal, const Vector3d& point) {
    return std::all_of(corners.begin(), corners.end(), [&](const Vector3d& corner) {
      return std::abs(normal.dot(corner - point)) <= tolerance;
    });
  };
  if (in_plane(a, normal_b, b[0]) || in_plane(b, normal_a, a[0])) {
    for (const Vector3d& side : sides_a)
      if (parts(normal_a.cross(side))) return false;
    for (const Vector3d& side : sides_b)
      if (parts(normal_a.cross(side))) return false;
    return true;
  }
  if (parts(normal_a) || parts(normal_b)) return false;
  for (const Vector3d& side_a : sides_a)
    for (const Vector3d& side_b : sides_b) {
      const Vector3d across = side_a.cross(side_b);
      constexpr double parallel = 1e-6;  // sine of an angle
      if (across.norm() > parallel * side_a.norm() * side_b.norm() && parts(across)) return false;
    }
  return true;
}

/// A tree of boxes around the triangles of a mesh. A node's triangles are a range of order_, halved at the
/// middle of its longest side.
class BoxTree {
 public:
  explicit BoxTree(const TriangleMesh& mesh) : order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      AlignedBox3d box;
      for (int corner = 0; corner < 3; ++corner) box.extend(mesh.corner(i, corner));
      boxes_.push_back(box);
    }
    build(0, order_.size());
  }

  /// Calls body(other) for the triangles after `triangle` whose boxes meet its own, until it returns true;
  /// returns whether it did.
  template <class Body>
  bool any_near(std::size_t triangle, const Body& body) const {
    std::vector<std::size_t> open = {0};
    while (!open.empty()) {
      const Node& node = nodes_[open.back()];
      open.pop_back();
      if (!node.box.intersects(boxes_[triangle])) continue;
      if (node.second == 0) {
        for (std::size_t i = node.begin; i < node.end; ++i)
          if (order_[i] > triangle && boxes_[order_[i]].intersects(boxes_[triangle]) && body(order_[i]))
            return true;
        continue;
      }
      open.push_back(node.first);
      open.push_back(node.second);
    }
    return false;
  }

 private:
  struct Node {
    AlignedBox3d box;
    std::size_t begin, end, first = 0, second = 0;  // second = 0: a leaf
  };
  static constexpr std::size_t leaf = 4;

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({{}, begin, end});
    AlignedBox3d box, centres;
    for (std::size_t i = begin; i < end; ++i) {
      box.extend(boxes_[order_[i]]);
      centres.extend(boxes_[order_[i]].center());
    }
    nodes_[at].box = box;
    if (end - begin <= leaf) return at;
    Eigen::Index axis;
    centres.sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto position = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(position(begin), position(middle), position(end), [&](std::size_t a, std::size_t b) {
      return boxes_[a].center()[axis] < boxes_[b].center()[axis];
    });
    const std::size_t first = build(begin, middle), second = build(middle, end);
    nodes_[at].first = first;
    nodes_[at].second = second;
    return at;
  }

  std::vector<std::size_t> order_;
  std::vector<AlignedBox3d> boxes_;
  std::vector<Node> nodes_;
};

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> overlapping_triangles(const TriangleMesh& mesh,
                                                                         double tolerance) {
  if (mesh.triangles.empty()) return std::nullopt;
  const BoxTree tree(mesh);
  const auto corners_of = [&](std::size_t i) {
    return Corners{mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
  };
  std::size_t found = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Corners corners = corners_of(i);
    const bool any = tree.any_near(i, [&](std::size_t other) {
      found = other;
      return overlap(corners, corners_of(other), tolerance);
    });
    if (any) return std::pair(i, found);
  }
  return std::nullopt;
}

}  // namespace sandstroke
