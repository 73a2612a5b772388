#include "core/interrupt.h"

#include <csignal>

namespace sandstroke {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void remember_signal(int signal) {
  caught_signal = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
}

int interrupted() { return caught_signal; }

}  // namespace sandstroke
