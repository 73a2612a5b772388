#include "tool/tool_elements.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "core/cells_per_group.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// A cube of space, and the components of the normal, rounded.
using Bin = std::array<std::int64_t, 6>;

struct Patch {
  Vector3d moment = Vector3d::Zero();  // m^3: area x centre
  Vector3d facing = Vector3d::Zero();  // m^2: area x normal
  double area = 0.0;                   // m^2
};

/// The layer of cubes, and the angle of the normal around z.
using Order = std::pair<std::int64_t, double>;

/// A number from 0 to 4 that grows with the angle of (x, y) from +x towards +y.
double around(double x, double y) {
  const double size = std::abs(x) + std::abs(y);
  if (size == 0.0) return 0.0;
  const double across = y / size;
  if (x < 0.0) return 2.0 - across;
  return across < 0.0 ? 4.0 + across : across;
}

class Patches {
 public:
  explicit Patches(double size) : size_(size) {}
  std::map<Bin, Patch> all;

  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (longest > size_) return divide(a, b, c, longest);
    const Vector3d facing = 0.5 * (b - a).cross(c - a), centre = (a + b + c) / 3.0;
    const double area = facing.norm();
    if (!(area > 0.0)) return;
    constexpr double directions = 1.0;  // steps on each side of 0 along an axis: about 50 degrees each
    Bin bin;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      bin[i] = static_cast<std::int64_t>(std::floor(centre[axis] / size_));
      bin[i + 3] = static_cast<std::int64_t>(std::round(directions * facing[axis] / area));
    }
    Patch& patch = all[bin];
    patch.moment += area * centre;
    patch.facing += facing;
    patch.area += area;
  }

 private:
  /// Divides a triangle in two across its longest side.
  void divide(const Vector3d& a, const Vector3d& b, const Vector3d& c, double longest) {
    if ((b - a).norm() == longest) return halves(a, b, c);
    if ((c - b).norm() == longest) return halves(b, c, a);
    halves(c, a, b);
  }
  void halves(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d middle = 0.5 * (a + b);
    add(a, middle, c);
    add(middle, b, c);
  }

  double size_;
};

}  // namespace

ToolElements::ToolElements(const TriangleMesh& surface, double size) {
  Patches patches(size);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    patches.add(surface.corner(i, 0), surface.corner(i, 1), surface.corner(i, 2));
  count_ = static_cast<int>(patches.all.size());
  size_ = (patches.all.size() + cells_per_group - 1) / cells_per_group * cells_per_group;
  columns_.assign(7 * size_, 0.0);
  // Sorts by layer, and by direction in each layer. So most groups of a kernel lie as a whole above or below
  // the sand, and lead or trail as a whole.
  std::vector<std::pair<Order, const Patch*>> order;
  for (const auto& [bin, patch] : patches.all)
    order.push_back({{bin[2], around(patch.facing.x(), patch.facing.y())}, &patch});
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& one, const auto& other) { return one.first < other.first; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Patch& patch = *order[i].second;
    centres_.emplace_back(patch.moment / patch.area);
    normals_.emplace_back(patch.facing.normalized());
    // The length of the vector sum: area x normal adds up to 0 over the whole surface, as it must if that is
    // closed.
    columns_[6 * size_ + i] = patch.facing.norm();
  }
  turn(Eigen::Matrix3d::Identity());
}

void ToolElements::turn(const Eigen::Matrix3d& rotation) {
  if (rotation == rotation_) return;
  rotation_ = rotation;
  lowest_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < centres_.size(); ++i) {
    const Vector3d centre = rotation * centres_[i], normal = rotation * normals_[i];
    lowest_ = std::min(lowest_, centre.z());
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      columns_[static_cast<std::size_t>(axis) * size_ + i] = centre[axis];
      columns_[static_cast<std::size_t>(axis + 3) * size_ + i] = normal[axis];
    }
  }
}

}  // namespace sandstroke
