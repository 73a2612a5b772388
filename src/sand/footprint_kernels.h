#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "sand/tool_footprint.h"
#include "tool/tool_settings.h"

namespace sandstroke {

// Vector code (Highway), the same bits for every instruction set: sums run over 8 lanes in all of them.

/// The numbers of a sphere's filters.
struct SphereShape {
  ToolProfile profile;
  double radius;         ///< m
  double filter_scale2;  ///< m^2, s^2: u = rho^2 / s^2
  double amplitude;      ///< m, a: the bowl has the sphere's curvature at the tip
  double reach;          ///< m, rho1 = s sqrt(u1)
};

/// Where a window of cells lies in a tool's envelope: the four samples around the window's first cell, and
/// their weights. Corners: lower left, lower right, upper left, upper right.
struct EnvelopeWindow {
  const double* underside[4];
  const double* cover[4];
  double weight[4];
  int stride;
  double lowest;  ///< m above the tip, of all undersides
};
/// The ways on which the sand of a window's cells leaves the tool.
struct WayOutWindow {
  const double *x, *y;  ///< the ways, from the window's first cell on [cells]
  int stride;
  /// Computes where the sand of a cell at (at_x, at_y) goes, from the axis [cells]; NaN: nowhere.
  void aim(int row, int col, double at_x, double at_y, double& to_x, double& to_y) const {
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(row) * stride + col;
    const bool goes = x[i] != 0.0 || y[i] != 0.0;
    to_x = goes ? at_x + x[i] : std::numeric_limits<double>::quiet_NaN();
    to_y = at_y + y[i];
  }
};

/// The sand level [m] of a placed footprint; NaN where no cell counts.
double level_of(const SphereShape& shape, const ToolFootprint& footprint);
/// Mean height [m], over the level's cells, by which the floor stands above the tip. The window must have a
/// floor.
double floor_above(const SphereShape& shape, const ToolFootprint& footprint, double tip_height);

// First pass (carve): fills underside() and takes(), lowers heights() to the underside of a tool whose tip is
// at tip_height [m], flags the lowered cells, and keeps their excess(). sum: the sum of heights taken out
// [m]. Where the floor is above the underside, sand is lowered to the floor.
// takes() and ring_weight() of a sphere are 0 where the floor is above its rim.

/// Carves only, and returns `sum`: for a sphere whose sand goes outward, or that only stands there
/// (tip_height infinite).
double carve(const SphereShape& shape, ToolFootprint& footprint, double tip_height);

/// The part of the ring that a motion fills: all of it if drag_fraction is 0, its front half if it is 1. A
/// cell p [m] ahead of the axis keeps the fraction 1 - drag_fraction (1 - clamp(p / dx + 1/2, 0, 1)) of its
/// ring_weight.
struct RingFront {
  double drag_fraction;
  Eigen::Vector2d direction;  ///< of the drag, a unit vector
};
struct Carved {
  double sum;
  double front_weight;  ///< sum of weights() over the ring
  double ring_weight;   ///< sum of ring_weight()
};
/// Carves, but leaves takes() alone. Fills ring_weight() and, with the part of it that the motion fills,
/// weights().
Carved carve_for_ring(const SphereShape& shape, ToolFootprint& footprint, double tip_height,
                      const RingFront& front);

/// Result of carve_under, which carves with any tool by its envelope; underside() is infinite beside the
/// footprint. highest [m above the tip]: the highest point that touched sand, -infinity if none did.
struct CarvedUnder {
  double sum, highest;
};
CarvedUnder carve_under(const EnvelopeWindow& envelope, ToolFootprint& footprint, double tip_height);
/// Keeps underside() where it is no higher than `height` [m above the tip]. Elsewhere it becomes infinite,
/// and takes() becomes 1 where there is sand.
void cover_up_to(ToolFootprint& footprint, double height);

/// Where the cut cells' sand goes along the tool's outward normal: to `distance` [m] from the axis of a
/// sphere, or along the way out of any other tool.
struct Outward {
  double distance;
  std::optional<WayOutWindow> way;
};
/// Fills weights() with that sand [m], whose sum is `carved`. Each cell's sand is divided (linearly) among
/// the four cells around its target, as far as they take any. Sand right on the axis, or with no such cell,
/// is left out. Returns the sum.
double spread_outward(ToolFootprint& footprint, double carved, const Outward& outward);

/// The weights that a deposit is in proportion to: weights() or ring_weight().
enum class DepositBy { weights, ring_weight };
/// Second pass (deposit): heights() += rise x weights. Flags the raised cells.
void deposit(ToolFootprint& footprint, double rise, DepositBy by);

}  // namespace sandstroke
