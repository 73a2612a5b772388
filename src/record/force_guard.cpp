#include "record/force_guard.h"

#include <algorithm>

#include "haptics/recording.h"
#include "rules/force.h"

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
    : limits_(limits), largest_change_(limits.rate / servo_rate), interlock_(limits.clear_time) {
  limits_.max_force = std::max(0.0, limits.max_force);
}

FeltForce ForceGuard::admit(double time, const FeltForce& wanted, const Eigen::Vector3d& held) noexcept {
  FeltForce given = wanted;
  if (!wanted.force.allFinite()) {
    interlock_.close();
    given.force.setZero();
    given.flags |= refused_force;
    return given;
  }
  if (limits_.max_force == 0.0) {  // the hand gets no force: nothing is cut
    given.force.setZero();
    return given;
  }
  if (!wanted.is_above_or_in_sand) interlock_.close();
  interlock_.see(time, wanted.is_above_or_in_sand ? std::max(length_of(wanted.force), wanted.due) : HUGE_VAL);
  const bool is_wanted = !wanted.force.isZero(0.0);
  if (!interlock_.is_open()) {
    given.force.setZero();
    if (is_wanted) given.flags |= interlocked_force;
    return given;
  }
  if (interlock_.open_for() < limits_.ramp && is_wanted) {
    given.force *= interlock_.open_for() / limits_.ramp;
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
