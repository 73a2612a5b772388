#include "sand/sand_before.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The squared length of a normal's horizontal part below which a side looks straight down or up.
constexpr double level = 1e-6;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A surface of a dozen squares of this size [m] has about the area of this one.
double side_size(const TriangleMesh& surface) {
  constexpr double sides = 12.0;
  double area = 0.0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Vector3d a = surface.corner(i, 0);
    area += 0.5 * (surface.corner(i, 1) - a).cross(surface.corner(i, 2) - a).norm();
  }
  return std::sqrt(area / sides);
}

Vector3d position(const ToolElements& e, std::size_t i) { return {e.x()[i], e.y()[i], e.z()[i]}; }
Vector3d normal(const ToolElements& e, std::size_t i) {
  return {e.normal_x()[i], e.normal_y()[i], e.normal_z()[i]};
}

/// Whether the tool covers the cell at this position [m]: the sand there reaches up to its underside.
class Covered {
 public:
  Covered(const ToolFootprint& footprint, double tip_height)
      : f_(footprint),
        tip_height_(tip_height),
        slack_(1e-9 * footprint.cell_size()),
        per_cell_(1.0 / footprint.cell_size()) {}

  bool operator()(const Vector2d& position) const {
    const int col = static_cast<int>(std::floor(position.x() * per_cell_ - f_.first_x() + 0.5)),
              row = static_cast<int>(std::floor(position.y() * per_cell_ - f_.first_y() + 0.5));
    if (row < 0 || col < 0 || row >= f_.cells().rows() || col >= f_.cells().cols()) return false;
    return tip_height_ + f_.underside(row)[col] <= f_.heights(row)[col] + slack_;
  }

 private:
  const ToolFootprint& f_;
  double tip_height_, slack_, per_cell_;
};

/// Mean height [m] of the sand from 3/4 to 5/4 of `reach` [m] beyond the edge. Where the bed ends before, its
/// last sand counts. The edge must lie on the bed.
double height_at_reach(const HeightField& bed, const Vector2d& edge, const Vector2d& outward, double reach) {
  constexpr int samples = 4;
  const auto height = [&](double far) {
    const Vector2d at = edge + far * outward;
    return bed.height_at(at.x(), at.y());
  };
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < samples; ++i) {
    const double here = height(reach * (0.75 + 0.5 * (i + 0.5) / samples));
    if (std::isnan(here)) break;
    sum += here;
    ++count;
  }
  if (count > 0) return sum / count;
  double inside = 0.0;
  for (double step = 0.5 * reach; step > 0.5 * bed.cell_size(); step *= 0.5)
    if (!std::isnan(height(inside + step))) inside += step;
  return height(inside);
}

}  // namespace

SandBefore::SandBefore(const TriangleMesh& surface, const ToolElements& elements)
    : size_(side_size(surface)),
      sides_(surface, size_),
      side_of_(hwy::AllocateAligned<std::int64_t>(elements.size())),
      known_(sides_.size(), unknown),
      heights_(sides_.size(), 0.0) {
  std::fill_n(side_of_.get(), elements.size(), 0);
  for (int i = 0; i < elements.count(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int side = 0; side < sides_.count(); ++side) {
      const double far = ((position(elements, i) - position(sides_, side)) / size_).squaredNorm() +
                         (normal(elements, i) - normal(sides_, side)).squaredNorm();
      if (far >= nearest) continue;
      nearest = far;
      side_of_[i] = side;
    }
  }
}

void SandBefore::lift() { std::fill(known_.begin(), known_.end(), unknown); }

bool SandBefore::look(const HeightField& bed, const ToolFootprint& footprint, const Vector3d& tip,
                      double foot, const Motion& motion, double wedge) {
  const Covered covered(footprint, tip.z());
  const double cell = bed.cell_size();
  const auto kept_after = [](const Vector3d& way) { return elementary::exp(-std::sqrt(way.squaredNorm())); };
  const bool spins = !motion.spin.isZero(0.0);
  const double kept_by_all = kept_after(motion.tip);
  for (int side = 0; side < sides_.count(); ++side) {
    double& height = known_[side];
    const Vector2d across(sides_.normal_x()[side], sides_.normal_y()[side]);
    const Vector3d from_tip = position(sides_, side);
    if (across.squaredNorm() < level) continue;
    const Vector2d outward = across / std::sqrt(across.squaredNorm());
    Vector2d edge = (tip + from_tip).head<2>();
    while (covered(edge)) edge += cell * outward;
    const double at_edge = bed.height_at(edge.x(), edge.y());
    // Half a step to where the wedge of the known height comes out: on a heap as steep as the wedge a whole
    // step would swing for ever.
    const auto seen_from = [&](double known) {
      const double reach = wedge * std::max(known - foot, 0.0);
      return std::min(0.5 * (known + height_at_reach(bed, edge, outward, reach)), at_edge);
    };
    if (std::isnan(at_edge)) {
      height = unknown;
    } else if (tip.z() + from_tip.z() - size_ > at_edge) {
      height = at_edge;  // the whole side is above the sand
    } else if (std::isnan(height)) {
      constexpr int rounds = 6;
      height = at_edge;
      for (int round = 0; round < rounds; ++round) height = seen_from(height);
    } else {
      const double seen = seen_from(height),
                   kept = spins ? kept_after(motion.tip + motion.spin * from_tip) : kept_by_all;
      height = seen + kept * (height - seen);
    }
  }
  return average_sides(tip.z(), foot);
}

bool SandBefore::average_sides(double tip_height, double foot) {
  double sum = 0.0, weights = 0.0;
  Vector2d directions = Vector2d::Zero(), heights = Vector2d::Zero();
  for (int side = 0; side < sides_.count(); ++side) {
    const double height = known_[side];
    if (std::isnan(height)) continue;
    // A side counts by its area in the sand, about, and by how much it looks sideways.
    const Vector2d across(sides_.normal_x()[side], sides_.normal_y()[side]);
    const double in_sand = std::clamp((height - tip_height - sides_.z()[side]) / size_ + 1.0, 0.0, 1.0),
                 weight = in_sand * sides_.area()[side] * across.squaredNorm();
    sum += weight * height;
    weights += weight;
    directions += weight * across;
    heights += weight * height * across;
  }
  if (!(weights > 0.0)) return false;
  around_ = sum / weights;
  ahead_ = (heights - around_ * directions) / weights;
  for (int side = 0; side < sides_.count(); ++side) {
    const Vector2d across(sides_.normal_x()[side], sides_.normal_y()[side]);
    const double without = across.squaredNorm() < level ? around_ : foot;  // beside the bed lies no sand
    heights_[side] = std::isnan(known_[side]) ? without : known_[side];
  }
  return true;
}

double SandBefore::highest() const {
  double most = around_ + std::sqrt(ahead_.squaredNorm());
  for (int side = 0; side < sides_.count(); ++side) most = std::max(most, heights_[side]);
  return most;
}

}  // namespace sandstroke
