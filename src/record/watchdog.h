#pragma once

#include <thread>

#include "record/servo_loop.h"

namespace sandstroke {

/// Looks after a loop from a thread of its own: where it has given no sign of life for `limit` [s] (a call
/// into the device hangs, the machine stands still), the device is released and the loop told to stop.
class Watchdog {
 public:
  Watchdog(ServoLoop& loop, HapticDevice& device, LoopClock& clock, double limit);
  ~Watchdog();
};

}  // namespace sandstroke
