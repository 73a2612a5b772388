#pragma once

#include <deque>
#include <utility>

namespace sandstroke {

/// How fast a count grew over the last second of its own time [1/s].
class RecentRate {
 public:
  /// The count at a time [s]. Where that goes back, a recording has begun after a wait: it begins anew.
  double at(double time, double count) {
    if (!last_second_.empty() && time < last_second_.back().first) last_second_.clear();
    last_second_.emplace_back(time, count);
    while (last_second_.size() > 2 && time - last_second_[1].first >= 1.0) last_second_.pop_front();
    const auto& [time_before, count_before] = last_second_.front();
    const double seconds = time - time_before;
    return seconds > 0.0 ? (count - count_before) / seconds : 0.0;
  }

 private:
  std::deque<std::pair<double, double>> last_second_;
};

}  // namespace sandstroke
