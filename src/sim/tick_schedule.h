#pragma once

#include <cstdint>

#include "rules/schedule.h"
#include "sim/idle_ticks.h"

namespace sandstroke {

/// The first tick of a range in which an event of this rate is due; the range's end if there is none.
inline std::int64_t next_due(const TickRange& ticks, double servo_rate, double rate) {
  const double due = times_due(ticks.begin, servo_rate, rate);
  if (times_due(ticks.end, servo_rate, rate) == due) return ticks.end;
  // Bisection: due(low) == due < due(high).
  std::int64_t low = ticks.begin, high = ticks.end;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (times_due(middle, servo_rate, rate) == due ? low : high) = middle;
  }
  return low;
}

}  // namespace sandstroke
