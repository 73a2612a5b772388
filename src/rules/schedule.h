#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/elementary.h"

namespace sandstroke {

/// The rates of the paper (section 5) [Hz]: a force every millisecond, and the visual loop, in which sand
/// relaxes.
inline constexpr double published_servo_rate = 1000.0, published_relaxation_rate = 60.0;

/// How often something at `rate` [Hz] has come due before this tick of a loop at servo_rate [Hz]. It comes
/// due once per period, in the last tick before each multiple of it, and at most once a tick.
inline double times_due(std::int64_t tick, double servo_rate, double rate) {
  if (rate <= 0.0) return 0.0;
  if (rate >= servo_rate) return static_cast<double>(tick);  // also where rate x tick overflows
  return std::floor(static_cast<double>(tick) * rate / servo_rate + 1e-9);
}

inline bool comes_due(std::int64_t tick, double servo_rate, double rate) {
  return times_due(tick + 1, servo_rate, rate) > times_due(tick, servo_rate, rate);
}

/// When sand relaxes by the way that a tool goes through it: as the tool touches down, each time it is some
/// way [m] along the bed, or up or down, from where sand relaxed last, and as it leaves. So a stroke's
/// outcome depends neither on its speed nor on how often it is sampled, and a tool that trembles within that
/// way relaxes nothing.
class RelaxationByWay {
 public:
  /// on: false = it is never due.
  explicit RelaxationByWay(bool on) : on_(on) {}

  /// With the tip here [m], in contact or not.
  bool is_due(const Eigen::Vector3d& tip, bool contact) const {
    if (!on_ || contact != relaxed_at_.has_value()) return on_;
    if (!contact) return false;
    const Eigen::Vector3d away = tip - *relaxed_at_;
    return elementary::hypot(away.x(), away.y()) >= next_ || std::abs(away.z()) >= next_;
  }

  /// The fraction of a straight step of the tip, below 1, at which the next relaxation is due by the way
  /// along the bed; none where none is due. (A tool that goes straight down is looked at when its step ends.)
  std::optional<double> way_to_next(const Eigen::Vector3d& from, const Eigen::Vector3d& step) const {
    if (!on_ || !relaxed_at_) return std::nullopt;
    // |away + fraction along| = next
    const Eigen::Vector2d away = (from - *relaxed_at_).head<2>(), along = step.head<2>();
    const double a = along.squaredNorm(), b = away.dot(along), c = away.squaredNorm() - next_ * next_;
    if (a == 0.0 || c >= 0.0) return std::nullopt;  // c: a reading jumped; the step's end sees to it
    const double fraction = (std::sqrt(b * b - a * c) - b) / a;
    return fraction < 1.0 ? std::optional(fraction) : std::nullopt;
  }

  /// Sand has relaxed with the tip here [m], and does so again when the tip has gone `next` [m].
  void relaxed(const Eigen::Vector3d& tip, bool contact, double next) {
    relaxed_at_ = contact ? std::optional(tip) : std::nullopt;
    next_ = next;
  }

  template <class State>
  void visit_state(State& state) {
    state.value("next", next_);
    state.value("relaxed_at", relaxed_at_);
  }

 private:
  bool on_;
  double next_ = 0.0;                          // m
  std::optional<Eigen::Vector3d> relaxed_at_;  // none: the tool was not in contact
};

}  // namespace sandstroke
