#pragma once

#include <string>

#include "cli/recent_rate.h"
#include "core/status_line.h"
#include "record/servo_loop.h"

namespace sandstroke {

/// Shows a recording in one line: time, rate over the last second, force, lateness.
class RecordDisplay {
 public:
  /// keys: text that names the keys which stop it; may be empty.
  explicit RecordDisplay(std::string keys) : keys_(std::move(keys)) {}
  void show(const ServoProgress& progress);

 private:
  StatusLine line_;
  std::string keys_;
  RecentRate rate_;
};

}  // namespace sandstroke
