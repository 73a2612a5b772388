#pragma once

#include <filesystem>

#include "record/loop_thread.h"

namespace sandstroke {

struct RecorderSettings {
  ServoSettings servo;
  int priority = 80;  ///< SCHED_FIFO, at most highest_loop_priority; 0 = not asked for
  bool lock_memory = true;
  double watchdog = 0.1;   ///< s, where a force may be given; else a loop that stood still just goes on
  double ring = 10.0;      ///< s of samples that the disk may be behind
  double watch = 0.1;      ///< s between two calls of the watcher
  bool calibrate = false;  ///< may move the arm
  bool allow_uncalibrated = false;  ///< to give forces
};

struct RecordingReport {
  RecordingHeader header;
  RecordingFooter footer;
  std::string disk_error;  ///< empty: the journal is whole; else why it is not, and without a footer
};

/// A whole recording into a journal: device opened (and calibrated) before the loop's thread starts, which is
/// joined; writer and watchdog; whatever ends it, device released and closed, journal finished. header: what
/// the caller knows (source, felt scene); the rest is filled in. A disk that takes no more ends it for the
/// reason `disk`, and what is in the journal is kept. Error: io, before the first sample; input, for a switch
/// that the device has not, or forces on one that is not calibrated; what the watcher throws, after the
/// journal was finished.
RecordingReport record(HapticDevice& device, FeltWorld* world, const RecorderSettings& settings,
                       RecordingHeader header, const std::filesystem::path& journal,
                       const RecordingWatcher& watcher);

}  // namespace sandstroke
