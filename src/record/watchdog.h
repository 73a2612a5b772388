#pragma once

#include <thread>

#include "record/servo_loop.h"

namespace sandstroke {

/// Now that it is `now`, a loop whose last sign of life was at `heartbeat` (0: it does not run) stands still.
/// All [ns]. The limit itself is none.
bool has_stalled(std::int64_t now, std::int64_t heartbeat, std::int64_t limit);

/// What a watchdog does at each look. True: the loop stands still, and is told to stop; the device is
/// released. The loop is told first: a force that it is about to command it then takes back itself.
bool release_if_stalled(ServoLoop& loop, HapticDevice& device, std::int64_t now, std::int64_t limit);

/// Looks after a loop from a thread of its own, four times per limit: where it has given no sign of life for
/// `limit` [s] (a call into the device hangs, the machine stands still), the device is released and the loop
/// told to stop.
class Watchdog {
 public:
  /// loop_priority: SCHED_FIFO's, of the loop; 0: not asked for. The watchdog asks for watchdog_priority.
  Watchdog(ServoLoop& loop, HapticDevice& device, LoopClock& clock, double limit, int loop_priority);

 private:
  std::jthread thread_;
};

}  // namespace sandstroke
