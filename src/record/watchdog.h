#pragma once

#include <thread>

#include "record/servo_loop.h"

namespace sandstroke {

/// True where a loop stands still at `now`. heartbeat: its last sign of life (0: it does not run). All [ns].
/// A pause of exactly the limit is allowed.
bool has_stalled(std::int64_t now, std::int64_t heartbeat, std::int64_t limit);

/// One look of a watchdog. True: the loop stands still and was told to stop; the device is released. The loop
/// is told first, so that it takes back itself a force that it is about to command.
bool release_if_stalled(ServoLoop& loop, HapticDevice& device, std::int64_t now, std::int64_t limit);

/// Watches a loop from a thread of its own, four times per limit. Where the loop has given no sign of life
/// for `limit` [s] (a call into the device hangs, the machine stands still), tells it to stop and releases
/// the device.
class Watchdog {
 public:
  /// loop_priority: the loop's SCHED_FIFO priority; 0: not asked for. The watchdog asks for
  /// watchdog_priority.
  Watchdog(ServoLoop& loop, HapticDevice& device, LoopClock& clock, double limit, int loop_priority);

 private:
  std::jthread thread_;
};

}  // namespace sandstroke
