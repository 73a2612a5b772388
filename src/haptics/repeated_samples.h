#pragma once

#include "haptics/stroke.h"

namespace sandstroke {

/// keep: as recorded. drop: without samples that repeat the last one.
enum class RepeatedSamples { keep, drop };

/// Repeated samples, as of a device that is read faster than it measures.
struct Repeats {
  double fraction = 0.0;   ///< of the samples, those that have the position of the one before
  std::size_t period = 1;  ///< samples from one measurement to the next
};
/// period: the length that nine of ten runs of equal positions do not exceed. The others are rests.
Repeats repeats_of(const Stroke& stroke);

/// The stroke without the samples that a device repeated. Keeps the first sample of each run of equal
/// positions, and every period-th after it that has a period's samples after it in the run. So a rest stays a
/// rest, which ends one measurement before the motion does. Also keeps the end of a joined piece, and the
/// samples that hold it together.
Stroke without_repeated_samples(const Stroke& stroke);

}  // namespace sandstroke
