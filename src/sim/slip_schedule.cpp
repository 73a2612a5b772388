#include "sim/slip_schedule.h"

#include <cmath>

#include "core/elementary.h"

namespace sandstroke {

bool SlipSchedule::is_due(const Eigen::Vector3d& tip, bool contact) const {
  if (!by_way_ || contact != slipped_at_.has_value()) return by_way_;
  if (!contact) return false;
  const Eigen::Vector3d away = tip - *slipped_at_;
  return elementary::hypot(away.x(), away.y()) >= next_ || std::abs(away.z()) >= next_;
}

std::optional<double> SlipSchedule::way_to_next(const Eigen::Vector3d& from,
                                                const Eigen::Vector3d& step) const {
  if (!by_way_ || !slipped_at_) return std::nullopt;
  // |away + share along| = next
  const Eigen::Vector2d away = (from - *slipped_at_).head<2>(), along = step.head<2>();
  const double a = along.squaredNorm(), b = away.dot(along), c = away.squaredNorm() - next_ * next_;
  if (a == 0.0 || c >= 0.0) return std::nullopt;  // c: a reading jumped; the tick's end sees to it
  const double share = (std::sqrt(b * b - a * c) - b) / a;
  return share < 1.0 ? std::optional(share) : std::nullopt;
}

}  // namespace sandstroke
