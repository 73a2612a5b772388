#include "compare/trace_difference.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {

TracePeaks trace_peaks(const std::vector<TickRecord>& trace) {
  TracePeaks peaks;
  for (const TickRecord& tick : trace) {
    peaks.force = std::max(peaks.force, tick.device_force.norm());
    peaks.depth = std::max(peaks.depth, tick.depth);
  }
  return peaks;
}

TraceDifference trace_difference(const std::vector<TickRecord>& golden, const std::vector<TickRecord>& run) {
  const auto largest = [&](const auto& distance) {
    ColumnDifference result;
    const std::size_t ticks = std::min(golden.size(), run.size());
    for (std::size_t tick = 0; tick < ticks && !std::isnan(result.max); ++tick) {
      const double d = distance(golden[tick], run[tick]);
      if (d <= result.max) continue;
      if (result.max == 0.0) result.first = golden[tick].time;
      result.max = d;
      result.tick = tick;
    }
    if (ticks > 0) result.time = golden[result.tick].time;
    return result;
  };
  using Tick = const TickRecord&;
  TraceDifference result;
  result.time = largest([](Tick a, Tick b) { return std::abs(b.time - a.time); });
  result.force = largest([](Tick a, Tick b) { return (b.device_force - a.device_force).norm(); });
  result.depth = largest([](Tick a, Tick b) { return std::abs(b.depth - a.depth); });
  result.level = largest([](Tick a, Tick b) {
    const bool lifted = !a.contact && !b.contact;
    if (lifted && std::isnan(a.level) && std::isnan(b.level)) return 0.0;
    return std::abs(b.level - a.level);
  });
  return result;
}

}  // namespace sandstroke
