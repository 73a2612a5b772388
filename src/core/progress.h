#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "core/status_line.h"

namespace sandstroke {

/// A progress bar with the time left, on a terminal after a second. Elsewhere the log says the same in a
/// line, after `silence` and whenever as much time has passed again, so that nothing long is silent.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Progress(std::string title, Clock::duration silence = std::chrono::seconds(20));

  /// fraction: done so far, 0 to 1. It is cheap enough to be called often.
  void update(double fraction);
  /// Shows how much is done, for work whose end is not known.
  void count(std::int64_t done, const char* what);

 private:
  bool due();
  void show(const std::string& bar, const std::string& text);
  std::string title_;
  Clock::time_point start_;
  StatusLine line_;
  Clock::time_point next_;
};

}  // namespace sandstroke
