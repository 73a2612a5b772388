#pragma once

#include <chrono>
#include <ctime>

namespace sandstroke {

/// The time on the clock since construction.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Runs since the process began, but for the loading of its libraries.
inline const Stopwatch process_watch;

/// Processor time of this process so far, all its threads together [s]. Other processes do not count.
inline double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace sandstroke
