#include "core/interrupt.h"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace sandstroke {
namespace {

std::atomic<int> caught_signal = 0;                    // set by one thread and asked for by others
std::atomic<std::int64_t> caught_at = 0;               // ns, the first one that may come twice
static_assert(std::atomic<int>::is_always_lock_free);  // or no signal handler might set it
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

constexpr std::int64_t together = 1'000'000'000;  // ns

void remember_signal(int signal) {
  caught_signal = signal;
  std::signal(signal, SIG_DFL);
}

void remember_first_signal(int signal) {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);  // which a signal handler may call (POSIX)
  const std::int64_t now = time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
  if (caught_signal == 0) {
    caught_at = now;
    caught_signal = signal;
  } else if (now - caught_at > together) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
}

void catch_all_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT}) std::signal(signal, remember_first_signal);
  if (std::signal(SIGHUP, remember_first_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGTSTP, SIG_IGN);
}

int interrupted() { return caught_signal; }

}  // namespace sandstroke
