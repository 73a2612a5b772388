#pragma once

#include "haptics/recording.h"

namespace sandstroke {

/// What a machine does to a servo loop without a device.
struct LoopCheck {
  Scheduling scheduling;
  RecordingFooter loop;
  bool fit = false;  ///< no tick was skipped, and 99 of 100 are less than a tenth of a tick late
};

/// Runs the loop for `seconds` at `rate` [Hz] without a device, under the scheduling that record() asks for.
LoopCheck check_loop(double seconds, double rate, int priority);

}  // namespace sandstroke
