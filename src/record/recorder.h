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
  bool allow_uncalibrated = false;  ///< gives forces all the same
};

struct RecordingReport {
  RecordingHeader header;
  RecordingFooter footer;
  std::string disk_error;  ///< empty: the journal is whole; else why it is not, and has no footer
};

/// Makes a whole recording into a journal. Opens (and calibrates) the device, then starts the loop's thread,
/// the writer and the watchdog. Whatever ends the recording, the thread is joined, the device released and
/// closed, and the journal finished. header: what the caller knows (source, felt scene); the rest is filled
/// in. Where the disk takes no more, the recording ends for the reason `disk`, and the journal keeps what it
/// has. Error: io, before the first sample; input, for a switch that the device has not, or forces on one
/// that is not calibrated; what the watcher throws, after the journal was finished.
RecordingReport record(HapticDevice& device, FeltWorld* world, const RecorderSettings& settings,
                       RecordingHeader header, const std::filesystem::path& journal,
                       const RecordingWatcher& watcher);

}  // namespace sandstroke
