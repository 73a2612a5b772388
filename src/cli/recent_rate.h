#pragma once

#include <deque>
#include <utility>

namespace sandstroke {

/// The rate [1/s] at which a count grew over the last second of its own time.
class RecentRate {
 public:
  /// Takes the count at a time [s] and returns the rate. Starts anew if the time goes back, as when a
  /// recording begins after a wait.
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
