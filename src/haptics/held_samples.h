#pragma once

#include "haptics/stroke.h"

namespace sandstroke {

/// keep: as recorded. drop: without samples that repeat the last one.
enum class HeldSamples { keep, drop };

/// What a device repeats that is read faster than it measures.
struct Repeats {
  double share = 0.0;      ///< of the samples, that have the position of the one before
  std::size_t period = 1;  ///< samples from one measurement to the next
};
/// period: the length that nine of ten runs of equal positions do not exceed. The others are rests.
Repeats repeats_of(const Stroke& stroke);

/// Without the samples that a device repeated. Of each run of equal positions the first is kept, and every
/// period-th after it that has a period's samples after it in the run: so a rest stays a rest, which ends one
/// measurement before the motion does. The end of a joined piece is kept, and what holds it together.
Stroke without_held_samples(const Stroke& stroke);

}  // namespace sandstroke
