#include "haptics/recorded_force.h"

#include <limits>

#include "haptics/recording.h"

namespace sandstroke {

bool RecordedForce::unaltered(std::size_t sample) const {
  constexpr std::uint32_t altered = clamped_force | ramped_force | rate_limited_force | refused_force |
                                    deferred_sand | interlocked_force | unfelt_force;
  return stroke_.flags.empty() || (stroke_.flags[sample] & altered) == 0;
}

Eigen::Vector3d RecordedForce::at(double since_first) {
  const Eigen::Vector3d unknown = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (stroke_.force.empty()) return unknown;
  const double time = stroke_.time.front() + since_first;
  while (cursor_ + 1 < stroke_.size() && stroke_.time[cursor_ + 1] <= time) ++cursor_;
  const Eigen::Vector3d recorded = sign_ * stroke_.force[cursor_];
  if (!unaltered(cursor_)) return unknown;
  if (time == stroke_.time[cursor_]) return recorded;
  if (!stroke_.joined(cursor_) || !unaltered(cursor_ + 1)) return unknown;
  const double share = (time - stroke_.time[cursor_]) / (stroke_.time[cursor_ + 1] - stroke_.time[cursor_]);
  return recorded + share * (sign_ * stroke_.force[cursor_ + 1] - recorded);
}

}  // namespace sandstroke
