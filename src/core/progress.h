#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "core/status_line.h"

namespace sandstroke {

/// A progress bar with the time left, on stderr. It appears after a second, and only on a terminal.
class Progress {
 public:
  explicit Progress(std::string title);

  /// fraction: done so far, 0 to 1. It is cheap enough to be called often.
  void update(double fraction);
  /// Shows how much is done, for work whose end is not known.
  void count(std::int64_t done, const char* what);

 private:
  using Clock = std::chrono::steady_clock;
  bool due();
  std::string title_;
  Clock::time_point start_;
  Clock::time_point next_draw_;
  StatusLine line_;
};

}  // namespace sandstroke
