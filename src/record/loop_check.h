#pragma once

#include "record/recorder.h"

namespace sandstroke {

/// Ticks: on a machine that is fit, 99 ticks of 100 are less late.
inline constexpr double fit_lateness = 0.1;

/// How a machine runs a servo loop without a device.
struct LoopCheck {
  Scheduling scheduling;
  RecordingFooter loop;
  bool fit = false;  ///< no tick was skipped, and 99 of 100 are less than a tenth of a tick late
};

/// Whether the machine is fit, for a loop that ran its whole time.
bool is_fit(const RecordingFooter& loop, double rate);

/// Runs the loop for `seconds` without a device, at the rate and under the scheduling that record() has with
/// these settings.
LoopCheck check_loop(double seconds, const RecorderSettings& settings, const RecordingWatcher& watcher = {});

}  // namespace sandstroke
