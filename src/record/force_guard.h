#pragma once

#include "record/felt_force.h"
#include "record/interlock.h"

namespace sandstroke {

/// What a force must keep to before it reaches a hand.
struct ForceLimits {
  double max_force = 0.0;    ///< N; 0 = no force at all
  double ramp = 1.0;         ///< s over which it fades in, each time the interlock opens
  double rate = 1000.0;      ///< N/s: per tick, however late that is, it changes by no more than rate x tick
  double clear_time = 0.05;  ///< s that the tool must be out of the sand before the first force (Interlock)
};

/// Between a world and a motor: forces that are no number are refused, those before the interlock opens
/// withheld (in both cases none is given, at once), others faded in, cut to the limit, and kept from jumping,
/// in this order. What is given is never larger than the limit, and is none or differs from the force held by
/// no more than the rate, but for rounding.
class ForceGuard {
 public:
  ForceGuard(const ForceLimits& limits, double servo_rate);
  /// The force that may be commanded at `time` [s] to a device that holds `held` [N] since the last tick, and
  /// the flags of what was done to it (nothing: none) beside its own. Times increase.
  FeltForce admit(double time, const FeltForce& wanted, const Eigen::Vector3d& held) noexcept;
  Interlock& interlock() { return interlock_; }
  const Interlock& interlock() const { return interlock_; }

 private:
  ForceLimits limits_;
  double largest_change_;  // N, per tick
  Interlock interlock_;
};

}  // namespace sandstroke
