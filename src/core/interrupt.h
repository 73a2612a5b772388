#pragma once

namespace sandstroke {

/// From here on SIGINT and SIGTERM only raise a flag, which long work asks for at its next step; a second one
/// ends the program at once.
void catch_interrupts();

/// The signal caught so far, or 0.
int interrupted();

}  // namespace sandstroke
