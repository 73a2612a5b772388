#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "record/spsc_ring.h"

namespace sandstroke {

/// Where a pointer's tip is to be at a time.
struct PointerKnot {
  std::int64_t time = 0;                          ///< ns, monotonic clock
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  ///< m, in the bed
  std::uint32_t switches = 0;
};

/// A smooth way through knots that come while it is followed: one thread adds them, another asks where the
/// tip is, without waiting, throwing or taking memory.
///
/// Every coordinate is a cubic from knot to knot, with slopes of three knots (the parabola through them),
/// limited so that it never leaves the range of the two knots around it (Steffen, Astron. Astrophys. 239,
/// 1990). So its speed has no steps. For knots of a smooth way, so long known before they are due that the
/// slopes are too, the error is of third order in their spacing, and of second where a coordinate turns
/// round. The way comes to rest at the last knot that is known in time: a pointer that rests sends nothing.
class PointerPath {
 public:
  /// Rests there at first. interval [ns]: from rest, it sets out so long before the next knot at most.
  PointerPath(const Eigen::Vector3d& home, std::int64_t interval);

  /// Times increase. False: so many knots wait already that this one is lost.
  bool add(const PointerKnot& knot) { return ring_.push(knot); }
  /// For times that do not decrease.
  PointerKnot at(std::int64_t time) noexcept;

 private:
  /// The next knot, where it is known.
  bool look_ahead() noexcept;
  void set_out(std::int64_t time) noexcept;

  SpscRing<PointerKnot> ring_;
  std::int64_t interval_;
  PointerKnot begin_, end_;                  // of the piece that is followed; the same: it rests
  Eigen::Vector3d begin_slope_, end_slope_;  // m/ns
  bool goes_on_ = false;                     // at end_, with end_slope_: the next knot was known in time
  std::optional<PointerKnot> next_;          // after end_, where it is known
  std::int64_t last_asked_ = 0;              // ns
};

}  // namespace sandstroke
