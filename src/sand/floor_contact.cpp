#include "sand/floor_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/elementary.h"
#include "sand/ground.h"
#include "tool/tool_elements.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// The free side of a plane: all ways with normal . way >= least.
struct HalfSpace {
  Vector3d normal;
  double least;
};

/// The shortest way in all of some half-spaces: it lies on the planes of one, two or three of them, and is a
/// sum of their normals with factors that are not negative. None: they have nothing in common.
class ShortestWay {
 public:
  static constexpr std::size_t most = 8;
  void add(const HalfSpace& half_space) { all_[count_++] = half_space; }
  std::size_t count() const { return count_; }

  std::optional<Vector3d> find() const {
    for (std::size_t i = 0; i < count_; ++i)
      if (const Vector3d way = all_[i].least * all_[i].normal; all_[i].least >= 0.0 && is_in_all(way))
        return way;
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (const auto way = on_both(all_[i], all_[j]); way && is_in_all(*way)) return way;
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t k = 0; k < j; ++k)
          if (const auto way = on_three(all_[i], all_[j], all_[k]); way && is_in_all(*way)) return way;
    return std::nullopt;
  }

 private:
  bool is_in_all(const Vector3d& way) const {
    return std::all_of(all_.begin(), all_.begin() + count_, [&](const HalfSpace& one) {
      return one.normal.dot(way) >= one.least - 1e-9 * std::abs(one.least);
    });
  }

  static std::optional<Vector3d> on_both(const HalfSpace& a, const HalfSpace& b) {
    const double both = a.normal.dot(b.normal), det = 1.0 - both * both;
    if (!(det > 1e-12)) return std::nullopt;
    const double of_a = (a.least - both * b.least) / det, of_b = (b.least - both * a.least) / det;
    if (of_a < 0.0 || of_b < 0.0) return std::nullopt;
    return of_a * a.normal + of_b * b.normal;
  }

  static std::optional<Vector3d> on_three(const HalfSpace& a, const HalfSpace& b, const HalfSpace& c) {
    const Vector3d bc = b.normal.cross(c.normal), ca = c.normal.cross(a.normal),
                   ab = a.normal.cross(b.normal);
    const double det = a.normal.dot(bc);
    if (!(std::abs(det) > 1e-9)) return std::nullopt;
    const Vector3d way = (a.least * bc + b.least * ca + c.least * ab) / det;
    if (way.dot(bc) / det < 0.0 || way.dot(ca) / det < 0.0 || way.dot(ab) / det < 0.0) return std::nullopt;
    return way;
  }

  std::array<HalfSpace, most> all_;
  std::size_t count_ = 0;
};

/// The surface's corners, one for each cube of this size [m]: the lowest there.
std::vector<Vector3d> thinned_corners(const TriangleMesh& surface, double size) {
  std::map<std::array<long, 3>, Vector3d> cubes;
  for (const Vector3d& corner : surface.vertices) {
    const auto cube = [&](double x) { return std::lround(std::floor(x / size)); };
    const auto [found, is_new] =
        cubes.try_emplace({cube(corner.x()), cube(corner.y()), cube(corner.z())}, corner);
    if (corner.z() < found->second.z()) found->second = corner;
  }
  std::vector<Vector3d> corners;
  for (const auto& [cube, corner] : cubes) corners.push_back(corner);
  return corners;
}

}  // namespace

FloorContact::FloorContact(const ToolSettings& tool, double cell_size) : cell_size_(cell_size) {
  if (tool.shape == ToolShape::sphere) {
    sphere_radius_ = reach_ = tool.radius;
    return;
  }
  const TriangleMesh surface = tool_surface(tool);
  own_points_ = thinned_corners(surface, cell_size);
  ToolElements elements(surface, cell_size);
  elements.turn(Eigen::Matrix3d::Identity());
  for (int i = 0; i < elements.count(); ++i)
    own_points_.emplace_back(elements.x()[i], elements.y()[i], elements.z()[i]);
  turn(own_rotation(tool));
}

void FloorContact::turn(const Eigen::Matrix3d& rotation) {
  if (sphere_radius_) return;
  rotation_ = rotation;
  points_.clear();
  reach_ = 0.0;
  lowest_ = std::numeric_limits<double>::infinity();
  for (const Vector3d& own : own_points_) {
    const Vector3d point = rotation * own;
    points_.push_back(point);
    reach_ = std::max(reach_, elementary::hypot(point.x(), point.y()));
    lowest_ = std::min(lowest_, point.z());
  }
}

void FloorContact::visit_state(StateVisitor& state) {
  state.value("floor.rotation", rotation_);
  if (state.restores()) turn(rotation_);
}

Vector3d FloorContact::deepest(const Vector3d& tip, const Vector3d& moved, double enough) const {
  const Vector3d at = tip + moved;
  if (sphere_radius_) {
    const FloorSurface::Side side = floor_.nearest(at + Vector3d(0.0, 0.0, *sphere_radius_), *sphere_radius_);
    const double depth = *sphere_radius_ - side.distance;
    return depth > enough ? Vector3d(depth * side.outward) : Vector3d::Zero();
  }
  Vector3d way = Vector3d::Zero();
  double deepest = enough;
  for (const Vector3d& from_tip : points_) {
    const Vector3d point = at + from_tip;
    if (!(floor_.height(point.x(), point.y()) - point.z() > deepest)) continue;
    const FloorSurface::Side side = floor_.nearest(point, 0.0);
    if (!(-side.distance > deepest)) continue;
    deepest = -side.distance;
    way = deepest * side.outward;
  }
  return way;
}

Vector3d FloorContact::way_out(const HeightField& bed, const Vector3d& tip) {
  if (!bed.ground()) return Vector3d::Zero();
  // Room for the way as well, and for the sides that a point deep in a stone looks for.
  const double reach = 2.0 * reach_ + 4.0 * cell_size_;
  if (!floor_.open(bed.ground()->floor, tip.x(), tip.y(), reach, tip.z() + lowest_)) return Vector3d::Zero();
  const double enough = 1e-7 * cell_size_;
  ShortestWay shortest;
  Vector3d moved = Vector3d::Zero();
  while (shortest.count() < ShortestWay::most) {
    const Vector3d way = deepest(tip, moved, enough);
    if (way.isZero(0.0)) break;
    const double length = std::sqrt(way.squaredNorm());
    const Vector3d normal = way / length;
    shortest.add({normal, length + normal.dot(moved)});
    const std::optional<Vector3d> next = shortest.find();
    if (!next) break;  // between two sides there is no room
    moved = *next;
  }
  return moved;
}

}  // namespace sandstroke
