#include "core/interrupt.h"

#include <atomic>
#include <csignal>

namespace sandstroke {
namespace {

std::atomic<int> caught_signal = 0;                    // set by one thread and asked for by others
static_assert(std::atomic<int>::is_always_lock_free);  // or no signal handler might set it

void remember_signal(int signal) {
  caught_signal = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
}

void catch_all_interrupts() {
  catch_interrupts();
  std::signal(SIGQUIT, remember_signal);
  if (std::signal(SIGHUP, remember_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGTSTP, SIG_IGN);
}

int interrupted() { return caught_signal; }

}  // namespace sandstroke
