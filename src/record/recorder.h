#pragma once

#include <filesystem>
#include <functional>

#include "record/servo_loop.h"

namespace sandstroke {

struct RecorderSettings {
  ServoSettings servo;
  int priority = 80;  ///< SCHED_FIFO; 0 = not asked for
  bool lock_memory = true;
  double watchdog = 0.1;   ///< s
  double ring = 10.0;      ///< s of samples that the disk may be behind
  bool calibrate = false;  ///< may move the arm
};

struct RecordingReport {
  RecordingHeader header;
  RecordingFooter footer;
};

/// Called about ten times a second in the thread that records, which is not the loop's: to show where it is,
/// and to ask whether to stop.
using RecordingWatcher = std::function<std::optional<StopReason>(const ServoProgress&)>;

/// A whole recording into a journal: device opened (and calibrated) before the loop's thread starts, which is
/// joined; writer and watchdog; whatever ends it, device released and closed, journal finished. header: what
/// the caller knows (source, felt scene); the rest is filled in. Error: io.
RecordingReport record(HapticDevice& device, FeltWorld* world, const RecorderSettings& settings,
                       RecordingHeader header, const std::filesystem::path& journal,
                       const RecordingWatcher& watcher);

}  // namespace sandstroke
