#include "record/watchdog.h"

#include "record/real_time.h"
#include "record/stoppable_sleep.h"

namespace sandstroke {

bool has_stalled(std::int64_t now, std::int64_t heartbeat, std::int64_t limit) {
  return heartbeat != 0 && now - heartbeat > limit;
}

bool release_if_stalled(ServoLoop& loop, HapticDevice& device, std::int64_t now, std::int64_t limit) {
  if (!has_stalled(now, loop.heartbeat(), limit)) return false;
  loop.stop(StopReason::stall);
  device.release();
  return true;
}

Watchdog::Watchdog(ServoLoop& loop, HapticDevice& device, LoopClock& clock, double limit, int loop_priority)
    : thread_([&loop, &device, &clock, limit = to_nanoseconds(limit),
               loop_priority](const std::stop_token& stop) {
        if (loop_priority > 0) ask_for_real_time(watchdog_priority(loop_priority), MemoryLock::not_asked);
        while (sleep_unless_stopped(stop, std::chrono::nanoseconds(limit / 4)))
          if (release_if_stalled(loop, device, clock.now(), limit)) return;
      }) {}

}  // namespace sandstroke
