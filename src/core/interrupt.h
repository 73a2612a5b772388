#pragma once

namespace sandstroke {

/// Makes this program ignore SIGPIPE and SIGXFSZ. A write to a pipe that nobody reads, or beyond a size limit
/// (ulimit -f), then fails like any other and ends nothing.
void ignore_write_signals();

/// Makes signals that ask this program to end only raise a flag, which long work checks at its next step.
/// These are SIGINT, SIGTERM, and all others from outside that would end it, such as SIGUSR1 (a batch
/// system's warning) and SIGXCPU (ulimit -t). A handler that nohup or a profiler has set stays. A second
/// signal ends the program at once, except SIGXCPU, which the system repeats every second. Call this where
/// long work begins: a program that still waits for an input, perhaps a pipe, must end at the first signal.
void catch_interrupts();

/// The same, also for Ctrl-\. Ctrl-Z, and using a terminal that another job has, do nothing. It is for work
/// that must not stand still, nor end before it has let go. Signals within a second of the first count as
/// one: a closed terminal sends two, a key kept pressed many.
void catch_all_interrupts();

/// The signal caught so far, or 0.
int interrupted();

}  // namespace sandstroke
