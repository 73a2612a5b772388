#pragma once

#include <cmath>
#include <cstdint>

#include "sim/idle_ticks.h"

namespace sandstroke {

/// In how many of the ticks before this one it came due: once per period, at the last tick before each
/// multiple of it; at most once a tick.
inline double times_due(std::int64_t tick, double servo_rate, double rate) {
  if (rate <= 0.0) return 0.0;
  if (rate >= servo_rate) return static_cast<double>(tick);  // also where rate x tick overflows
  return std::floor(static_cast<double>(tick) * rate / servo_rate + 1e-9);
}

inline bool comes_due(std::int64_t tick, double servo_rate, double rate) {
  return times_due(tick + 1, servo_rate, rate) > times_due(tick, servo_rate, rate);
}

/// The first tick of a range in which it comes due; its end where there is none.
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
