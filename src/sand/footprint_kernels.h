#pragma once

#include <Eigen/Core>

#include "sand/tool_footprint.h"

namespace sandstroke {

// Vector code (Highway), the same bits for every instruction set: sums run over 8 lanes in all of them.

/// The sand level [m] of a placed footprint; NaN where no cell counts.
double level_of(const FootprintShape& shape, const ToolFootprint& footprint);

// What its cells mean to the tool: underside() and takes(); rampart().
void shape_bowl(const FootprintShape& shape, ToolFootprint& footprint);
void shape_ring(const FootprintShape& shape, ToolFootprint& footprint);

/// First pass: lowers heights() to the tool's underside, its tip at tip_height [m], and flags those cells,
/// with their excess(). Returns the sum of heights taken out [m].
double carve(ToolFootprint& footprint, double tip_height);

/// How much of the ring a motion fills: all of it where drag_share is 0, its front half where it is 1. A cell
/// that lies p [m] ahead of the axis keeps 1 - drag_share (1 - clamp(p / dx + 1/2, 0, 1)) of its rampart.
struct RingFront {
  double drag_share;
  Eigen::Vector2d direction;  ///< of the drag, a unit vector
};
/// Sums of weights over the ring.
struct RingWeight {
  double front;  ///< of those left in weights()
  double whole;  ///< of the rampart
};
/// Fills weights() with the rampart's share for a motion.
RingWeight weigh_ring(ToolFootprint& footprint, const RingFront& front);

/// Where the cut cells' sand goes along the tool's outward normal, to `distance` [m] from the axis.
struct Outward {
  double distance;
  double shift;  ///< m: x + shift - shift rounds x so that sums of such parts are exact
};
/// Fills weights() with that sand: each cell's is shared among the four cells around its place (linearly)
/// that take any. Sand right on the axis, or with no such cell, is left out. Returns the sum.
double spread_outward(ToolFootprint& footprint, const Outward& outward);

/// Second pass: heights() += rise x weights() (or the rampart), which it flags.
void heap(ToolFootprint& footprint, double rise, bool whole_ring);

}  // namespace sandstroke
