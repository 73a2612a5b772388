#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/lagged_moments.h"
#include "sim/run_result.h"

namespace sandstroke {

inline ForcePair forces_of(const TickRecord& tick) {
  return {tick.time, tick.device_force, tick.recorded_force};
}

/// How well the forces of a run and those that were recorded agree, over the ticks that have both. None if no
/// tick has both.
///
/// The correlation is that of the vectors, each less its mean: sum(a.b) / sqrt(sum(a.a) sum(b.b)). The lag is
/// the one at which the correlation is largest. It is a whole number of ticks, up to half a second either
/// way, with at least half of the ticks in both; long traces are searched in evenly chosen stretches
/// (lagged_moments()). If the correlation still grows at half a second, there is no lag: 0. A force that
/// never changes has no correlation: NaN.
std::optional<ForceAgreement> force_agreement(const std::vector<ForcePair>& ticks);

/// The agreement as text, "differs from the run's by 0.3 N rms ...", to follow "the recorded force".
std::string text_of(const ForceAgreement& agreement);

}  // namespace sandstroke
