#pragma once

#include "record/recorder.h"

namespace sandstroke {

/// What a machine does to a servo loop without a device.
struct LoopCheck {
  Scheduling scheduling;
  RecordingFooter loop;
  bool fit = false;  ///< no tick was skipped, and 99 of 100 are less than a tenth of a tick late
};

/// Runs the loop for settings.servo.duration without a device, under the scheduling that record() asks for;
/// watcher as record()'s.
LoopCheck check_loop(const RecorderSettings& settings, const RecordingWatcher& watcher);

}  // namespace sandstroke
