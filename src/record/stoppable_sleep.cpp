#include "record/stoppable_sleep.h"

#include <condition_variable>
#include <mutex>

namespace sandstroke {

bool sleep_unless_stopped(const std::stop_token& stop, std::chrono::nanoseconds time) {
  std::mutex mutex;
  std::condition_variable_any stopped;  // which only the token notifies
  std::unique_lock lock(mutex);
  return !stopped.wait_for(lock, stop, time, [&stop] { return stop.stop_requested(); });
}

}  // namespace sandstroke
