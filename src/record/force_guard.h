#pragma once

#include "record/felt_force.h"

namespace sandstroke {

/// What a force must keep to before it reaches a hand.
struct ForceLimits {
  double max_force = 0.0;  ///< N; 0 = no force at all
  double ramp = 1.0;       ///< s over which it fades in
  double rate = 1000.0;    ///< N/s: per tick, however late that is, it changes by no more than rate x tick
};

/// Between a world and a motor: forces that are no number are refused (and none is given), others faded in,
/// cut to the limit, and kept from jumping, in this order.
class ForceGuard {
 public:
  ForceGuard(const ForceLimits& limits, double servo_rate);
  /// The force that may be commanded at `time` [s], and the flags of what was done to it beside its own.
  FeltForce admit(double time, const FeltForce& wanted) noexcept;

 private:
  ForceLimits limits_;
  double largest_change_;                            // N, per tick
  Eigen::Vector3d given_ = Eigen::Vector3d::Zero();  // N, in the tick before
};

}  // namespace sandstroke
