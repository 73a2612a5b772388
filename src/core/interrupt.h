#pragma once

namespace sandstroke {

/// From here on SIGINT and SIGTERM only raise a flag, which long work asks for at its next step; a second one
/// ends the program at once.
void catch_interrupts();

/// The same for a terminal that is closed (unless nohup asks to outlive that) and Ctrl-\, and Ctrl-Z does
/// nothing: for work that must not stand still, nor end before it has let go. So those that come within a
/// second of the first are taken for the same one: a closed terminal sends two, a key that is held many.
void catch_all_interrupts();

/// The signal caught so far, or 0.
int interrupted();

}  // namespace sandstroke
