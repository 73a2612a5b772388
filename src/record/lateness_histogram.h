#pragma once

#include <cstdint>
#include <vector>

#include "haptics/recording.h"

namespace sandstroke {

/// Lateness of any number of ticks in a fixed memory, all taken when it is made. Mean and maximum are exact;
/// the percentile is too large by at most 1 us below 10 ms, and the maximum above.
class LatenessHistogram {
 public:
  LatenessHistogram() : ticks_(bins) {}
  /// late [ns]: below 0 counts as 0.
  void add(std::int64_t late) noexcept;
  std::int64_t max() const noexcept { return max_; }  ///< ns
  /// p99: of 99 of 100 ticks none is later (the ceil(0.99 n)th of n); all 0 before the first.
  Lateness summary() const noexcept;

 private:
  static constexpr std::int64_t bin = 1000;    // ns
  static constexpr std::size_t bins = 10'000;  // later ones are counted in all_ only
  std::vector<std::int64_t> ticks_;
  std::int64_t all_ = 0, sum_ = 0, max_ = 0;  // ticks, ns, ns
};

}  // namespace sandstroke
