#include "sim/recorded_force.h"

#include <algorithm>
#include <cmath>

#include "haptics/recording.h"

namespace sandstroke {

bool RecordedForce::unaltered(std::size_t sample) const {
  constexpr std::uint32_t altered =
      clamped_force | ramped_force | rate_limited_force | refused_force | held_sand | interlocked_force;
  return stroke_.flags.empty() || (stroke_.flags[sample] & altered) == 0;
}

void RecordedForce::on_tick(const TickRecord& tick) {
  const double time = stroke_.time.front() + tick.time;
  while (cursor_ + 1 < stroke_.size() && stroke_.time[cursor_ + 1] <= time) ++cursor_;
  Eigen::Vector3d recorded = stroke_.force[cursor_];
  if (!unaltered(cursor_)) return;
  if (time != stroke_.time[cursor_]) {
    if (!stroke_.joined(cursor_) || !unaltered(cursor_ + 1)) return;
    const double share = (time - stroke_.time[cursor_]) / (stroke_.time[cursor_ + 1] - stroke_.time[cursor_]);
    recorded += share * (stroke_.force[cursor_ + 1] - recorded);
  }
  const double difference = (tick.device_force - recorded).norm();
  squares_.add(difference * difference);
  max_ = std::max(max_, difference);
  ++ticks_;
}

ForceDifference RecordedForce::difference() const {
  return {ticks_, ticks_ > 0 ? std::sqrt(squares_.value() / static_cast<double>(ticks_)) : 0.0, max_};
}

}  // namespace sandstroke
