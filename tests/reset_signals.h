#pragma once

#include <signal.h>

namespace sandstroke {

/// No signal is ignored or blocked from here on, though what started the tests may ignore some (nohup).
inline void reset_signals() {
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

}  // namespace sandstroke
