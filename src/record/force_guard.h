#pragma once

#include "record/felt_force.h"
#include "record/interlock.h"

namespace sandstroke {

/// The limits of a force before it reaches a hand.
struct ForceLimits {
  double max_force = 0.0;    ///< N; 0 = no force at all
  double ramp = 1.0;         ///< s over which it fades in, each time the interlock opens
  double rate = 1000.0;      ///< N/s: per tick, however late it is, the force changes by at most rate x tick
  double clear_time = 0.05;  ///< s that the tool must be out of the sand before the first force (Interlock)
};

/// Stands between a world and a motor. In this order: it refuses forces that are no number, withholds those
/// before the interlock opens (both give zero force at once), and fades in, cuts to the limit and keeps from
/// jumping all others. The given force is never larger than the limit. It is zero, or differs from the held
/// force by no more than the rate, but for rounding.
class ForceGuard {
 public:
  ForceGuard(const ForceLimits& limits, double servo_rate);
  /// The force that may be commanded at `time` [s] to a device that has held `held` [N] since the last tick.
  /// Its flags are those of `wanted`, and those of what was done to it. Times increase.
  FeltForce admit(double time, const FeltForce& wanted, const Eigen::Vector3d& held) noexcept;
  Interlock& interlock() { return interlock_; }
  const Interlock& interlock() const { return interlock_; }

 private:
  ForceLimits limits_;
  double largest_change_;  // N, per tick
  Interlock interlock_;
};

}  // namespace sandstroke
