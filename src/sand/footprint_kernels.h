#pragma once

#include <Eigen/Core>

#include "sand/tool_footprint.h"

namespace sandstroke {

// Vector code (Highway), the same bits for every instruction set: sums run over 8 lanes in all of them.

/// Fills a placed footprint's underside and rampart. Returns the sand level [m]; NaN where no cell counts.
double shape_footprint(const FootprintShape& shape, ToolFootprint& footprint);

/// How much of the ring a motion fills: all of it where drag_share is 0, its front half where it is 1. A cell
/// that lies p [m] ahead of the axis keeps 1 - drag_share (1 - clamp(p / dx + 1/2, 0, 1)) of its rampart.
struct RingFront {
  double drag_share;
  Eigen::Vector2d direction;  ///< of the drag, a unit vector
};

struct Carved {
  double pushed;        ///< m: sum of heights taken out
  double front_weight;  ///< sums of weights over the ring: of those left in weights(), ...
  double ring_weight;   ///< ... and of the rampart
};
/// First pass: lowers heights() to the tool's underside, its tip at tip_height [m], and flags those cells;
/// fills weights() with the rampart's share for a motion.
Carved carve(ToolFootprint& footprint, double tip_height, const RingFront& front);

/// Second pass: heights() += rise x weights() (or the rampart), which it flags.
void heap(ToolFootprint& footprint, double rise, bool whole_ring);

}  // namespace sandstroke
