#pragma once

#include <string>

#include "cli/recent_rate.h"
#include "core/status_line.h"
#include "record/servo_loop.h"

namespace sandstroke {

/// The line that shows a recording: time, rate reached over the last second, force, lateness.
class RecordDisplay {
 public:
  /// keys: which of them stop it, for people; may be empty.
  explicit RecordDisplay(std::string keys) : keys_(std::move(keys)) {}
  void show(const ServoProgress& progress);

 private:
  StatusLine line_;
  std::string keys_;
  RecentRate rate_;
};

}  // namespace sandstroke
