#include "haptics/late_force.h"

#include <algorithm>
#include <utility>

#include "core/hash.h"

namespace sandstroke {

bool drops_tick(std::int64_t tick, double fraction) {
  return unit_hash((static_cast<std::uint64_t>(tick) + 1) * 0x9e3779b97f4a7c15ULL) < fraction;
}

LateForce::LateForce(const DeviceSettings& settings, const Eigen::Vector3d& before)
    : dropped_fraction_(settings.dropped_ticks),
      given_out_(before),
      under_way_(static_cast<std::size_t>(settings.delay), before) {}

Eigen::Vector3d LateForce::act(const Eigen::Vector3d& computed) {
  const std::int64_t tick = tick_++;
  dropped_ = drops_tick(tick, dropped_fraction_);
  if (!dropped_) given_out_ = computed;
  if (under_way_.empty()) return given_out_;
  return std::exchange(under_way_[static_cast<std::size_t>(tick) % under_way_.size()], given_out_);
}

void LateForce::clear() {
  given_out_.setZero();
  std::fill(under_way_.begin(), under_way_.end(), given_out_);
}

}  // namespace sandstroke
