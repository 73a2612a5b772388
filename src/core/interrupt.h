#pragma once

namespace sandstroke {

/// For the whole program: a write to a pipe that nobody reads (SIGPIPE), or beyond a limit of size (SIGXFSZ,
/// ulimit -f), fails like any other and ends nothing.
void ignore_write_signals();

/// From here on what asks this program to end only raises a flag, which long work asks for at its next step:
/// SIGINT, SIGTERM, and of all others that would end it those that come from outside, such as SIGUSR1 (a
/// batch system's warning) and SIGXCPU (ulimit -t). What nohup or a profiler has set stays. A second one ends
/// the program at once, but for SIGXCPU, which the system repeats every second. To be called where such work
/// begins: what waits for an input, a pipe perhaps, is to end at the first.
void catch_interrupts();

/// The same, also for Ctrl-\, and Ctrl-Z and a terminal that others have do nothing: for work that must not
/// stand still, nor end before it has let go. So those that come within a second of the first are taken for
/// the same one: a closed terminal sends two, a key that is held many.
void catch_all_interrupts();

/// The signal caught so far, or 0.
int interrupted();

}  // namespace sandstroke
