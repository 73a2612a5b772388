#pragma once

#include <Eigen/Core>
#include <optional>

#include "sand/tool_footprint.h"

namespace sandstroke {

// Vector code (Highway), the same bits for every instruction set: sums run over 8 lanes in all of them.

/// The sand level [m] of a placed footprint; NaN where no cell counts.
double level_of(const FootprintShape& shape, const ToolFootprint& footprint);

// First pass: fills underside() and takes(), lowers heights() to the tool's underside, its tip at tip_height
// [m], and flags those cells, with their excess(). pushed [m]: the sum of heights taken out.

/// And no more: for a tool whose sand is spread, or that only stands there (tip_height infinite).
double carve(const FootprintShape& shape, ToolFootprint& footprint, double tip_height);

/// How much of the ring a motion fills: all of it where drag_share is 0, its front half where it is 1. A cell
/// that lies p [m] ahead of the axis keeps 1 - drag_share (1 - clamp(p / dx + 1/2, 0, 1)) of its rampart.
struct RingFront {
  double drag_share;
  Eigen::Vector2d direction;  ///< of the drag, a unit vector
};
struct Carved {
  double pushed;
  double front_weight;  ///< sums of weights over the ring: of those left in weights(), ...
  double ring_weight;   ///< ... and of the rampart
};
/// And fills rampart(), and weights() with its share for a motion.
Carved carve_for_ring(const FootprintShape& shape, ToolFootprint& footprint, double tip_height,
                      const RingFront& front);

/// And so of any tool, by its envelope: underside() is infinite beside its footprint. highest [m above the
/// tip]: of what touched sand, -infinity where nothing did.
struct CarvedUnder {
  double pushed, highest;
};
CarvedUnder carve_under(const EnvelopePlace& envelope, ToolFootprint& footprint, double tip_height);
/// Of underside() only what is no higher than `height` [m above the tip] counts: it is infinite elsewhere,
/// and takes() sand.
void cover_up_to(ToolFootprint& footprint, double height);

/// Where the cut cells' sand goes along the tool's outward normal: of a sphere to `distance` [m] from the
/// axis, of any other tool by its way out.
struct Outward {
  double distance;
  double shift;  ///< m: x + shift - shift rounds x so that sums of such parts are exact
  std::optional<WayOutPlace> way = {};
};
/// Fills weights() with that sand: each cell's is shared among the four cells around its place (linearly)
/// that take any. Sand right on the axis, or with no such cell, is left out. Returns the sum.
double spread_outward(ToolFootprint& footprint, const Outward& outward);

/// Second pass: heights() += rise x weights() (or the rampart), which it flags.
void heap(ToolFootprint& footprint, double rise, bool whole_ring);

}  // namespace sandstroke
