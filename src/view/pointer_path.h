#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "record/spsc_ring.h"

namespace sandstroke {

/// The place of a pointer's tip at a time.
struct PointerKnot {
  std::int64_t time = 0;                          ///< ns, monotonic clock
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  ///< m, in the bed
  std::uint32_t switches = 0;
};

/// A smooth way through knots that come while it is followed. One thread adds knots. Another asks where the
/// tip is, without waiting, throwing or taking memory.
///
/// Every coordinate is a cubic from knot to knot. Its slopes come from three knots (the parabola through
/// them), limited so that it never leaves the range of the two knots around it (Steffen, Astron. Astrophys.
/// 239, 1990). So its speed has no steps. The error is of third order in the knots' spacing, and of second
/// order where a coordinate turns round, if the knots lie on a smooth way, and each is known early enough
/// for the slope at the knot before it. The way comes to rest at the last knot that is known in time: a
/// pointer that rests sends nothing.
class PointerPath {
 public:
  /// The tip rests at `home` first. interval [ns]: from rest, it sets out at most so long before the next
  /// knot.
  PointerPath(const Eigen::Vector3d& home, std::int64_t interval);

  /// Times increase. False: too many knots wait already, and this one is lost.
  bool add(const PointerKnot& knot) { return ring_.push(knot); }
  /// The tip at `time`; times do not decrease.
  PointerKnot at(std::int64_t time) noexcept;

 private:
  /// The next knot, where it is known.
  bool look_ahead() noexcept;
  void set_out(std::int64_t time) noexcept;

  SpscRing<PointerKnot> ring_;
  std::int64_t interval_;
  PointerKnot begin_, end_;                  // of the piece that is followed; they are equal at rest
  Eigen::Vector3d begin_slope_, end_slope_;  // m/ns
  bool goes_on_ = false;                     // past end_, with end_slope_: the next knot was known in time
  std::optional<PointerKnot> next_;          // after end_, where it is known
  std::int64_t last_asked_ = 0;              // ns
};

}  // namespace sandstroke
