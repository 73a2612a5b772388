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
    const double at_col = std::floor(position.x() * per_cell_ - f_.first_x() + 0.5),
                 at_row = std::floor(position.y() * per_cell_ - f_.first_y() + 0.5);
    if (!(at_row >= 0.0 && at_col >= 0.0 && at_row < f_.cells().rows() && at_col < f_.cells().cols()))
      return false;
    const int row = static_cast<int>(at_row), col = static_cast<int>(at_col);
    return tip_height_ + f_.underside(row)[col] <= f_.heights(row)[col] + slack_;
  }

 private:
  const ToolFootprint& f_;
  double tip_height_, slack_, per_cell_;
};

/// Where a side's wedge goes: along its normal (a horizontal unit vector), and the more it leads, the more
/// along the way that the tool takes.
Vector2d leaving(const Vector2d& outward, const Vector2d& way) {
  const double leads = outward.dot(way), size = std::sqrt(way.squaredNorm());
  if (!(leads > 0.0 && size > 0.0)) return outward;  // a tiny way's square may underflow
  const Vector2d blend = (1.0 - leads) * outward + leads / size * way;
  return blend / std::sqrt(blend.squaredNorm());
}

/// m; NaN where no sand can lie.
double sand_at(const HeightField& bed, const Vector2d& at) {
  const double row = std::round(bed.row_at(at.y())), col = std::round(bed.col_at(at.x()));
  if (!(row >= 0.0 && col >= 0.0 && row < bed.rows() && col < bed.cols())) return unknown;
  const int r = static_cast<int>(row), c = static_cast<int>(col);
  return bed.has_sand(r, c) ? bed(r, c) : unknown;
}

/// Mean height [m] of the sand from 3/4 to 5/4 of `reach` [m] beyond the edge. Where the bed ends before, its
/// last sand counts. There must be sand at the edge.
double height_at_reach(const HeightField& bed, const Vector2d& edge, const Vector2d& outward, double reach) {
  constexpr int samples = 4;
  const auto height = [&](double far) { return sand_at(bed, edge + far * outward); };
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

/// Whether a ray from `from` along `along` goes into the body through this triangle.
bool enters(const Vector3d& from, const Vector3d& along, const Vector3d& a, const Vector3d& b,
            const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, out = ab.cross(ac), off = from - a;
  const double facing = -along.dot(out);  // Moeller and Trumbore
  if (!(facing > 0.0)) return false;
  const Vector3d turned = off.cross(along);
  const double u = ac.dot(turned), v = -ab.dot(turned), far = off.dot(out);
  return u >= 0.0 && v >= 0.0 && u + v <= facing && far > 0.0;
}

}  // namespace

SandBefore::SandBefore(const TriangleMesh& surface, const ToolElements& elements)
    : size_(side_size(surface)),
      sides_(surface, size_),
      side_of_(hwy::AllocateAligned<std::int64_t>(elements.size())),
      ways_(sides_.size(), Vector3d::Zero()),
      known_(sides_.size(), unknown),
      heights_(sides_.size(), 0.0),
      looks_at_tool_(sides_.size(), false) {
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
  for (int side = 0; side < sides_.count(); ++side)
    for (std::size_t i = 0; i < surface.triangles.size() && !looks_at_tool_[side]; ++i)
      looks_at_tool_[side] = enters(position(sides_, side), normal(sides_, side), surface.corner(i, 0),
                                    surface.corner(i, 1), surface.corner(i, 2));
}

void SandBefore::lift() {
  std::fill(known_.begin(), known_.end(), unknown);
  std::fill(ways_.begin(), ways_.end(), Vector3d::Zero());
}

bool SandBefore::look(const HeightField& bed, const ToolFootprint& footprint, const Vector3d& tip,
                      double foot, const Motion& motion, double wedge) {
  const Covered covered(footprint, tip.z());
  const double cell = bed.cell_size();
  const bool spins = !motion.spin.isZero(0.0);
  for (int side = 0; side < sides_.count(); ++side) {
    const Vector2d across(sides_.normal_x()[side], sides_.normal_y()[side]);
    const Vector3d from_tip = position(sides_, side);
    if (across.squaredNorm() < level || looks_at_tool_[side]) continue;
    Vector3d& way = ways_[side];
    const Vector3d moved = spins ? Vector3d(motion.tip + motion.spin * from_tip) : motion.tip;
    way += moved;
    way /= std::max(std::sqrt(way.squaredNorm()), 1.0);
    const Vector2d outward = leaving(across / std::sqrt(across.squaredNorm()), way.head<2>());
    Vector2d edge = (tip + from_tip).head<2>();
    while (covered(edge)) edge += cell * outward;
    const double at_edge = sand_at(bed, edge);
    if (std::isnan(at_edge)) continue;  // the bed ends here: what was known stays
    double& height = known_[side];
    if (tip.z() + from_tip.z() - size_ > at_edge) {  // the whole side is above the sand
      height = at_edge;
      way = Vector3d::Zero();
      continue;
    }
    // To where the wedge of the known height comes out, by at most half: on a heap as steep as the wedge
    // whole steps would swing for ever.
    constexpr double most_rounds = 6.0;
    const double moved_by = std::sqrt(moved.squaredNorm());
    const bool is_new = std::isnan(height);
    const double rounds = is_new ? most_rounds : std::clamp(std::ceil(moved_by), 1.0, most_rounds);
    const double step = is_new ? 0.5 : std::min(0.5, 1.0 - elementary::exp(-moved_by / rounds));
    if (is_new) height = at_edge;
    for (double round = 0.0; round < rounds && step > 0.0; ++round) {
      const double reach = wedge * std::max(height - foot, 0.0);
      height += step * (std::min(height_at_reach(bed, edge, outward, reach), at_edge) - height);
    }
  }
  return average_sides(tip.z(), foot);
}

bool SandBefore::average_sides(double tip_height, double foot) {
  mean_ = {};
  for (int side = 0; side < sides_.count(); ++side) {
    const double height = known_[side];
    if (std::isnan(height)) continue;
    // A side counts by its area in the sand, about, and by how much it looks sideways.
    const Vector2d across(sides_.normal_x()[side], sides_.normal_y()[side]);
    const double in_sand = std::clamp((height - tip_height - sides_.z()[side]) / size_ + 1.0, 0.0, 1.0),
                 weight = in_sand * sides_.area()[side] * across.squaredNorm();
    mean_.height += weight * height;
    mean_.weight += weight;
    mean_.height_ahead += weight * height * across;
    mean_.weight_ahead += weight * across;
  }
  if (!(mean_.weight > 0.0)) return false;
  for (int side = 0; side < sides_.count(); ++side) {
    const double without = looks_at_tool_[side] ? foot : mean_.height / mean_.weight;
    heights_[side] = std::isnan(known_[side]) ? without : known_[side];
  }
  return true;
}

double SandBefore::highest() const { return *std::max_element(heights_.begin(), heights_.end()); }

}  // namespace sandstroke
