#include "record/loop_clock.h"

#include <cerrno>
#include <ctime>

namespace sandstroke {
namespace {

constexpr std::int64_t nanoseconds = 1'000'000'000;

}  // namespace

std::int64_t MonotonicClock::now() noexcept {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * nanoseconds + time.tv_nsec;
}

void MonotonicClock::sleep_until(std::int64_t time) noexcept {
  const timespec deadline{time / nanoseconds, time % nanoseconds};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

}  // namespace sandstroke
