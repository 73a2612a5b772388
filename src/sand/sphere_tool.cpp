#include "sand/sphere_tool.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "rules/filter.h"

namespace sandstroke {
namespace {

/// The part of the ring that a motion fills. With Deposit::ahead it is the front half for a drag. In between
/// it is blended by the horizontal fraction of the motion, so that a plunge that turns into a drag makes no
/// jump.
RingFront front_of(const Eigen::Vector3d& motion, Deposit deposit) {
  const double horizontal = elementary::hypot(motion.x(), motion.y());
  if (deposit != Deposit::ahead || horizontal == 0.0) return {0.0, Eigen::Vector2d::Zero()};
  return {horizontal / (horizontal + std::abs(motion.z())), motion.head<2>() / horizontal};
}

}  // namespace

SphereTool::SphereTool(const ToolSettings& settings)
    : Tool(settings.radius, filter::reach(settings.radius)),
      shape_{settings.profile, settings.radius, settings.radius * settings.radius / filter::u0,
             settings.radius / (2.0 * filter::u0), filter::reach(settings.radius)} {}

void SphereTool::place(const HeightField& bed, double x, double y) {
  footprint_.set_axis(bed, x, y);
  const double extent = reach_ / bed.cell_size() + 1.0;  // cells; beyond it the level weight is 0
  const bool has_sand = footprint_.open(bed, {-extent, extent, -extent, extent});
  level_ = has_sand ? level_of(shape_, footprint_) : std::numeric_limits<double>::quiet_NaN();
}

double SphereTool::displace_in_footprint(const HeightField& bed, double tip_height,
                                         const Eigen::Vector3d& motion,
                                         const DisplacementSettings& settings) {
  if (settings.deposit == Deposit::outward) {
    const double carved = carve(shape_, footprint_, tip_height);
    if (carved == 0.0) return 0.0;
    const double spread =
        std::isfinite(carved) ? spread_outward(footprint_, carved, {settings.distance * radius_, {}}) : 0.0;
    if (spread > 0.0) {
      deposit(footprint_, carved / spread, DepositBy::weights);
      return carved;
    }
    footprint_.read_heights(bed);  // all cells around are bowl or wall: the ring takes the sand
  }
  const Carved carved = carve_for_ring(shape_, footprint_, tip_height, front_of(motion, settings.deposit));
  // A wall right ahead may cut off the whole front; then the rest of the ring takes the sand.
  const DepositBy by = carved.front_weight > 0.0 ? DepositBy::weights : DepositBy::ring_weight;
  const double weight = by == DepositBy::weights ? carved.front_weight : carved.ring_weight;
  if (carved.sum == 0.0 || !(weight > 0.0)) return 0.0;
  deposit(footprint_, carved.sum / weight, by);
  return carved.sum;
}

void SphereTool::carve_only(double tip_height) { carve(shape_, footprint_, tip_height); }

double SphereTool::floor_above(double height) const {
  return sandstroke::floor_above(shape_, footprint_, height);
}

void SphereTool::cover() { carve(shape_, footprint_, std::numeric_limits<double>::infinity()); }

double SphereTool::sand_above_rim(const HeightField& bed, double tip_height) {
  read_heights(bed);
  const ToolFootprint& f = footprint_;
  const double rim = radius_ / f.cell_size(), beyond = rim + 1.0;  // cells
  double highest = -std::numeric_limits<double>::infinity();
  for (int row = 0; row < f.cells().rows(); ++row) {
    const double y = f.first_y() + row - f.axis_y();
    const ColumnRange sand = f.sand_cols(row);
    for (int col = sand.begin; col < sand.end; ++col) {
      const double x = f.first_x() + col - f.axis_x(), rho2 = x * x + y * y;
      if (rho2 > rim * rim && rho2 <= beyond * beyond) highest = std::max(highest, f.heights(row)[col]);
    }
  }
  return highest - (tip_height + radius_);
}

}  // namespace sandstroke
