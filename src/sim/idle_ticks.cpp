#include "sim/idle_ticks.h"

#include <cmath>

#include "rules/schedule.h"

namespace sandstroke {

std::vector<TickRange> idle_ticks(const Stroke& stroke, const DeviceSettings& device) {
  constexpr double edge = 0.5;  // s
  if (device.model != DeviceModel::kinematic || device.delay > 0 || device.dropped_ticks > 0.0) return {};
  std::vector<TickRange> idle;
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    if (stroke.sampled_between(i)) continue;
    const double begin = stroke.time[i] - stroke.time.front() + edge,
                 end = stroke.time[i + 1] - stroke.time.front() - edge;
    const TickRange range{static_cast<std::int64_t>(std::ceil(begin * device.servo_rate)),
                          static_cast<std::int64_t>(std::floor(end * device.servo_rate))};
    if (range.begin < range.end) idle.push_back(range);
  }
  return idle;
}

std::int64_t next_due(const TickRange& ticks, double servo_rate, double rate) {
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
