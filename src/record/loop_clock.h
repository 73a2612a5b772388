#pragma once

#include <cmath>
#include <cstdint>

namespace sandstroke {

inline std::int64_t to_nanoseconds(double seconds) { return std::llround(seconds * 1e9); }
inline double to_seconds(std::int64_t nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

/// The clock of the servo loop [ns]. Tests give it one that goes as they like.
class LoopClock {
 public:
  virtual ~LoopClock() = default;
  virtual std::int64_t now() noexcept = 0;
  /// Returns at `time` or later, at once where that has passed.
  virtual void sleep_until(std::int64_t time) noexcept = 0;
};

/// CLOCK_MONOTONIC. It sleeps until absolute times.
class MonotonicClock : public LoopClock {
 public:
  std::int64_t now() noexcept override;
  void sleep_until(std::int64_t time) noexcept override;
};

}  // namespace sandstroke
