#pragma once

namespace sandstroke {

/// The standard output took not all that was printed, for this reason (errno). Error: io; where its reader
/// has gone, as `head` does, the program ends quietly, by SIGPIPE as others do.
[[noreturn]] void throw_output_error(int error);

/// What was printed is out. Error: as above.
void flush_output();

}  // namespace sandstroke
