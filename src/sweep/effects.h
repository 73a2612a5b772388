#pragma once

#include <vector>

#include "sweep/collected_sweep.h"

namespace sandstroke {

/// What one axis, or two together beyond what each does alone, do to a metric.
struct Effect {
  std::vector<std::size_t> axes;  ///< one or two
  double share;                   ///< fraction of the metric's variance over the sweep
  double least, greatest;         ///< of the means over the other axes, in the metric's unit
};

/// The effects on a metric, the largest first; none if it is the same at all points or has under two values.
/// Points without a value are left out; then the means of an axis hold effects of others, too.
///
/// Grid: the variance of the axis's means, and of the means of pairs without both axes' own (Sobol's shares
/// of a full factorial). Latin hypercube: one axis at a time; the means are over runs of neighbouring values,
/// and the share is freed of what chance gives such groups (adjusted eta squared).
std::vector<Effect> effects_on(const CollectedSweep& sweep, std::size_t metric);

/// The axes of a grid that change no metric but timings, and let no point fail. Empty if no metric has two
/// values.
std::vector<std::size_t> idle_axes(const CollectedSweep& sweep);

}  // namespace sandstroke
