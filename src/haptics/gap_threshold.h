#pragma once

#include "haptics/stroke.h"

namespace sandstroke {

inline constexpr double least_gap = 0.1;        ///< s; no hand pauses and moves on sooner
inline constexpr double spacings_of_a_gap = 5;  ///< as many usual spacings without a sample are a gap

/// The gap threshold [s] of samples that come with none: least_gap, or spacings_of_a_gap times the median
/// spacing, if that is more. Spacings while the pen is lifted do not count.
double usual_gap_threshold(const Stroke& stroke);

}  // namespace sandstroke
