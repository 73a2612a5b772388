#include "record/lateness_histogram.h"

#include <algorithm>

#include "record/loop_clock.h"

namespace sandstroke {

void LatenessHistogram::add(std::int64_t late) noexcept {
  late = std::max<std::int64_t>(late, 0);
  ++all_;
  sum_ += late;
  max_ = std::max(max_, late);
  const auto index = static_cast<std::size_t>(late / bin);
  if (index < bins) ++ticks_[index];
}

Lateness LatenessHistogram::summary() const noexcept {
  if (all_ == 0) return {};
  const std::int64_t rank = all_ - all_ / 100;  // ceil(0.99 n)
  std::int64_t counted = 0, p99 = max_;
  for (std::size_t i = 0; i < bins && counted < rank; ++i) {
    counted += ticks_[i];
    if (counted >= rank) p99 = std::min(max_, static_cast<std::int64_t>(i + 1) * bin);
  }
  return {to_seconds(sum_) / static_cast<double>(all_), to_seconds(p99), to_seconds(max_)};
}

}  // namespace sandstroke
