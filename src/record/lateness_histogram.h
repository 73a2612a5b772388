#pragma once

#include <cstdint>
#include <vector>

#include "haptics/recording.h"

namespace sandstroke {

/// The lateness of any number of ticks, in fixed memory that is taken when it is made. Mean and maximum are
/// exact. The percentile is too large by at most 1 us below 10 ms; above, it is the maximum.
class LatenessHistogram {
 public:
  LatenessHistogram() : ticks_(bins) {}
  /// late [ns]: below 0 counts as 0.
  void add(std::int64_t late) noexcept;
  std::int64_t max() const noexcept { return max_; }  ///< ns
  /// p99: 99 of 100 ticks are no later (the ceil(0.99 n)th of n). All are 0 before the first tick.
  Lateness summary() const noexcept;

 private:
  static constexpr std::int64_t bin = 1000;    // ns
  static constexpr std::size_t bins = 10'000;  // later ones are counted in all_ only
  std::vector<std::int64_t> ticks_;
  std::int64_t all_ = 0, sum_ = 0, max_ = 0;  // ticks, ns, ns
};

}  // namespace sandstroke
