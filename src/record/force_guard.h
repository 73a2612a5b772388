#pragma once

#include "record/felt_force.h"

namespace sandstroke {

/// What a force must keep to before it reaches a hand.
struct ForceLimits {
  double max_force = 0.0;  ///< N; 0 = no force at all
  double ramp = 1.0;       ///< s over which it fades in
  double rate = 1000.0;    ///< N/s: per tick, however late that is, it changes by no more than rate x tick
};

/// Between a world and a motor: forces that are no number are refused (and none is given, at once), others
/// faded in, cut to the limit, and kept from jumping, in this order. For any force that is a number, what is
/// given is no larger than the limit and differs from the force held by no more than the rate, but for
/// rounding.
class ForceGuard {
 public:
  ForceGuard(const ForceLimits& limits, double servo_rate);
  /// The force that may be commanded at `time` [s] to a device that holds `held` [N] since the last tick, and
  /// the flags of what was done to it (nothing: none) beside its own.
  FeltForce admit(double time, const FeltForce& wanted, const Eigen::Vector3d& held) const noexcept;

 private:
  ForceLimits limits_;
  double largest_change_;  // N, per tick
};

}  // namespace sandstroke
