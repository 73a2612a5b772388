#include "record/watchdog.h"

#include <chrono>

#include "record/real_time.h"

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
    : thread_([this, &loop, &device, &clock, limit, loop_priority] {
        if (loop_priority > 0) ask_for_real_time(watchdog_priority(loop_priority), false);
        watch(loop, device, clock, to_nanoseconds(limit));
      }) {}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Watchdog::watch(ServoLoop& loop, HapticDevice& device, LoopClock& clock, std::int64_t limit) {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, std::chrono::nanoseconds(limit / 4), [this] { return ends_; })) {
    if (release_if_stalled(loop, device, clock.now(), limit)) return;
  }
}

}  // namespace sandstroke
