#include "record/force_guard.h"

#include <algorithm>

#include "haptics/recording.h"

namespace sandstroke {
namespace {

/// Cuts a vector to a length. True: it was longer.
bool cut(Eigen::Vector3d& vector, double length) {
  const double largest = vector.cwiseAbs().maxCoeff();
  if (largest == 0.0) return false;
  const Eigen::Vector3d scaled = vector / largest;  // its squares do not overflow
  if (largest * scaled.norm() <= length) return false;
  vector = scaled * (length / scaled.norm());
  return true;
}

}  // namespace

ForceGuard::ForceGuard(const ForceLimits& limits, double servo_rate)
    : limits_(limits), largest_change_(limits.rate / servo_rate) {
  limits_.max_force = std::max(0.0, limits.max_force);
}

FeltForce ForceGuard::admit(double time, const FeltForce& wanted,
                            const Eigen::Vector3d& held) const noexcept {
  FeltForce given = wanted;
  if (!wanted.force.allFinite()) {
    given.force.setZero();
    given.flags |= refused_force;
    return given;
  }
  if (time < limits_.ramp && !given.force.isZero(0.0)) {
    given.force *= time / limits_.ramp;
    given.flags |= ramped_force;
  }
  if (cut(given.force, limits_.max_force)) given.flags |= clamped_force;
  Eigen::Vector3d change = given.force - held;
  if (cut(change, largest_change_)) {
    given.force = held + change;
    given.flags |= rate_limited_force;
  }
  return given;
}

}  // namespace sandstroke
