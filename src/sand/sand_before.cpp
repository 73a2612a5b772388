#include "sand/sand_before.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/elementary.h"
#include "sand/sand_plane.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The squared length of a normal's horizontal part below which a side looks straight down or up.
constexpr double level_below = 1e-6;
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

/// Whether the tool covers the cell at this position [m]: its underside is below the sand there, or below
/// `level` [m]. Where the tool rises, or goes on, it leaves a hollow in a height field, and sand would have
/// closed that.
class Covered {
 public:
  Covered(const ToolFootprint& footprint, double tip_height, double level)
      : f_(footprint),
        tip_height_(tip_height),
        level_(level),
        slack_(1e-9 * footprint.cell_size()),
        per_cell_(1.0 / footprint.cell_size()) {}

  bool operator()(const Vector2d& position) const {
    const double at_col = position.x() * per_cell_ - f_.first_x() + 0.5,
                 at_row = position.y() * per_cell_ - f_.first_y() + 0.5;
    if (!(at_row >= 0.0 && at_col >= 0.0 && at_row < f_.cells().rows() && at_col < f_.cells().cols()))
      return false;
    const int row = static_cast<int>(at_row), col = static_cast<int>(at_col);
    return tip_height_ + f_.underside(row)[col] <= std::max(f_.heights(row)[col], level_) + slack_;
  }

 private:
  const ToolFootprint& f_;
  double tip_height_, level_, slack_, per_cell_;
};

/// Where a side's wedge goes: along its normal (a horizontal unit vector), and the more it leads, the more
/// along the way that the tool takes.
Vector2d leaving(const Vector2d& outward, const Vector2d& way) {
  const double leads = outward.dot(way), size = std::sqrt(way.squaredNorm());
  if (!(leads > 0.0 && size > 0.0)) return outward;  // a tiny way's square may underflow
  const Vector2d blend = (1.0 - leads) * outward + leads / size * way;
  return blend / std::sqrt(blend.squaredNorm());
}

/// m; NaN where no sand can lie. Of a column whose floor stands above the tool's foot [m] only the sand
/// counts, as if it stood on the foot's height.
double sand_at(const HeightField& bed, const Vector2d& at, double foot) {
  const double row = bed.row_at(at.y()) + 0.5, col = bed.col_at(at.x()) + 0.5;
  if (!(row >= 0.0 && col >= 0.0 && row < bed.rows() && col < bed.cols())) return unknown;
  const int r = static_cast<int>(row), c = static_cast<int>(col);
  if (!bed.has_sand(r, c)) return unknown;
  return bed.ground() ? bed(r, c) - std::max(bed.floor(r, c) - foot, 0.0) : bed(r, c);
}

/// Mean height [m] of the sand from 3/4 to 5/4 of `reach` [m] beyond the edge. Where the bed ends before, its
/// last sand counts. There must be sand at the edge.
double height_at_reach(const HeightField& bed, const Vector2d& edge, const Vector2d& outward, double reach,
                       double foot) {
  constexpr int samples = 4;
  const auto height = [&](double far) { return sand_at(bed, edge + far * outward, foot); };
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

/// Where the sand before a side begins, that is at `at` [m]: so many cells out, each a step of `cell_out`
/// [m]. That is where it was, or near there.
Vector2d edge_before(int& cells, const Vector2d& at, const Vector2d& cell_out, const Covered& covered) {
  while (covered(at + cells * cell_out)) ++cells;
  while (cells > 0 && !covered(at + (cells - 1) * cell_out)) --cells;
  return at + cells * cell_out;
}

/// Cells of way after which a side looks at the sand again, and the tool at its slope.
constexpr double looks_every = 0.125, fits_every = 0.5;

/// The fraction of a difference that a height makes up at a time, at most. On a heap as steep as the wedge,
/// whole steps would swing for ever.
constexpr double longest_step = 0.5;

/// The fraction that it makes up in a tick's way of so many yields: 1 - exp(-yields) (a Pade fraction, to
/// 1e-4), up to the longest step.
double followed(double yields) {
  const double x = std::min(yields, 1.0);
  return std::min(longest_step, x / (1.0 + x * (0.5 + x / 12.0)));
}

/// Whether a level ray from `from` along `along` goes into the body through this triangle (Moeller and
/// Trumbore). Most triangles are wholly above or below it.
bool enters(const Vector3d& from, const Vector3d& along, const Vector3d& a, const Vector3d& b,
            const Vector3d& c) {
  const auto [lowest, highest] = std::minmax({a.z(), b.z(), c.z()});
  if (from.z() < lowest || from.z() > highest) return false;
  const Vector3d ab = b - a, ac = c - a, out = ab.cross(ac);
  const double facing = -along.dot(out);
  if (!(facing > 0.0)) return false;
  const Vector3d off = from - a, turned = off.cross(along);
  const double u = ac.dot(turned), v = -ab.dot(turned), far = off.dot(out);
  return u >= 0.0 && v >= 0.0 && u + v <= facing && far > 0.0;
}

}  // namespace

SandBefore::SandBefore(const TriangleMesh& surface, const ToolElements& elements)
    : size_(side_size(surface)),
      sides_(surface, size_),
      side_of_(elements.size()),
      outward_(sides_.size(), Vector2d::Zero()),
      weights_(sides_.size(), 0.0),
      ways_(sides_.size(), Vector3d::Zero()),
      cells_out_(sides_.size(), 0),
      since_(sides_.size(), 0.0),
      seen_(sides_.size(), unknown),
      places_(sides_.size(), Vector2d::Zero()),
      known_(sides_.size(), unknown),
      heights_(sides_.size(), 0.0),
      enclosed_(sides_.size(), false) {
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
  for (int side = 0; side < sides_.count(); ++side) enclosed_[side] = is_enclosed(side, surface);
  find_outward();
}

/// Whether the side looks sideways or up, and the tool is all around it: every level ray that leaves the side
/// goes into the tool again.
bool SandBefore::is_enclosed(int side, const TriangleMesh& surface) const {
  constexpr double looks_down = -0.5;
  constexpr int rays = 8;
  const Vector3d from = position(sides_, side), looks = normal(sides_, side);
  if (looks.z() < looks_down) return false;
  for (int ray = 0; ray < rays; ++ray) {
    const double angle = 2.0 * std::numbers::pi * (ray + 0.25) / rays;
    const Vector3d along(elementary::cos(angle), elementary::sin(angle), 0.0);
    if (along.dot(looks) < 0.0) continue;
    bool is_free = true;
    for (std::size_t i = 0; i < surface.triangles.size() && is_free; ++i)
      is_free = !enters(from, along, surface.corner(i, 0), surface.corner(i, 1), surface.corner(i, 2));
    if (is_free) return false;
  }
  return true;
}

void SandBefore::turn(const Eigen::Matrix3d& rotation) {
  sides_.turn(rotation);
  find_outward();
}

void SandBefore::find_outward() {
  reach_ = 0.0;
  for (int side = 0; side < sides_.count(); ++side) {
    const Vector2d across(sides_.normal_x()[side], sides_.normal_y()[side]);
    const double square = across.squaredNorm();
    const bool is_level = square < level_below;
    weights_[side] = sides_.area()[side] * square;
    outward_[side] = is_level || enclosed_[side] ? Vector2d::Zero() : Vector2d(across / std::sqrt(square));
    if (is_level) known_[side] = unknown;
    reach_ = std::max(reach_, position(sides_, side).head<2>().norm());
  }
}

void SandBefore::lift() {
  level_ = -std::numeric_limits<double>::infinity();
  std::fill(known_.begin(), known_.end(), unknown);
  std::fill(ways_.begin(), ways_.end(), Vector3d::Zero());
  std::fill(cells_out_.begin(), cells_out_.end(), 0);
}

bool SandBefore::look(const HeightField& bed, const ToolFootprint& footprint, const Vector3d& tip,
                      double foot, const Motion& motion, double wedge) {
  const Covered covered(footprint, tip.z(), level_);
  const double looks_after = looks_every * bed.cell_size();
  const bool spins = !motion.spin.isZero(0.0);
  Vector3d moved = motion.tip;
  double moved_by = std::sqrt(moved.squaredNorm()), follows = followed(moved_by);
  for (int side = 0; side < sides_.count(); ++side) {
    if (outward_[side].isZero(0.0)) continue;
    const Vector3d from_tip = position(sides_, side), at = tip + from_tip;
    if (spins) {
      moved = motion.tip + motion.spin * from_tip;
      moved_by = std::sqrt(moved.squaredNorm());
      follows = followed(moved_by);
    }
    Vector3d& way = ways_[side];
    way += moved;
    if (const double square = way.squaredNorm(); square > 1.0) way *= 1.0 / std::sqrt(square);
    since_[side] += moved_by * motion.yield_way;
    double &height = known_[side], &seen = seen_[side];
    const bool is_new = std::isnan(height);
    if (!is_new && since_[side] < looks_after) {
      height += follows * (seen - height);
      continue;
    }
    since_[side] = 0.0;
    const Vector2d outward = leaving(outward_[side], way.head<2>()),
                   edge = edge_before(cells_out_[side], at.head<2>(), bed.cell_size() * outward, covered);
    const double at_edge = sand_at(bed, edge, foot);
    if (std::isnan(at_edge)) continue;  // the bed ends here: what was known stays
    if (is_new) height = at_edge;
    places_[side] = edge - tip.head<2>();
    if (at.z() - size_ > at_edge) {  // the whole side is above the sand
      height = seen = at_edge;
      way = Vector3d::Zero();
      continue;
    }
    // To where the wedge of the known height comes out, in steps.
    constexpr double most_rounds = 6.0;
    const double rounds = is_new ? most_rounds : std::clamp(std::ceil(moved_by), 1.0, most_rounds);
    for (double round = 0.0; round < rounds; ++round) {
      const double reach = wedge * std::max(height - foot, 0.0),
                   there = height_at_reach(bed, edge, outward, reach, foot);
      seen = std::min(there, at_edge);
      places_[side] = edge - tip.head<2>();
      if (there < at_edge) places_[side] += reach * outward;
      height += (is_new ? longest_step : followed(moved_by / rounds)) * (seen - height);
    }
  }
  follow_slope(bed, tip, std::sqrt(motion.tip.squaredNorm()), motion);
  return average_sides(tip.z());
}

void SandBefore::follow_slope(const HeightField& bed, const Vector3d& tip, double moved_by,
                              const Motion& motion) {
  const bool is_new = std::isinf(level_);
  slope_since_ += moved_by * motion.yield_way;
  if (is_new || slope_since_ >= fits_every * bed.cell_size()) {
    slope_since_ = 0.0;
    slope_seen_ = fit_sand_plane(bed, tip.x(), tip.y(), reach_).slope;
  }
  slope_ += (is_new ? 1.0 : followed(moved_by)) * (slope_seen_ - slope_);
}

bool SandBefore::average_sides(double tip_height) {
  const double per_size = 1.0 / size_;
  mean_ = {};
  for (int side = 0; side < sides_.count(); ++side) {
    const double height = known_[side];
    if (std::isnan(height)) continue;
    // A side counts by its area in the sand, about.
    const double in_sand = std::clamp((height - tip_height - sides_.z()[side]) * per_size + 1.0, 0.0, 1.0),
                 weight = in_sand * weights_[side];
    if (!(weight > 0.0)) continue;
    const Vector2d across(sides_.normal_x()[side], sides_.normal_y()[side]);
    const double at_tip = height - slope_.dot(places_[side]);
    mean_.height += weight * at_tip;
    mean_.weight += weight;
    mean_.height_ahead += weight * at_tip * across;
    mean_.weight_ahead += weight * across;
  }
  if (!(mean_.weight > 0.0)) return false;
  level_ = mean_.height / mean_.weight;
  for (int side = 0; side < sides_.count(); ++side)
    heights_[side] = enclosed_[side]            ? -std::numeric_limits<double>::infinity()
                     : std::isnan(known_[side]) ? level_
                                                : known_[side];
  return true;
}

double SandBefore::highest() const { return *std::max_element(heights_.begin(), heights_.end()); }

}  // namespace sandstroke
