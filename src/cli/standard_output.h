#pragma once

namespace sandstroke {

/// Reports that the standard output could not be written (errno `error`). Error: io. If its reader has gone,
/// as `head` does, the program ends quietly by SIGPIPE, as other programs do.
[[noreturn]] void throw_output_error(int error);

/// Flushes the standard output. Errors as above.
void flush_output();

}  // namespace sandstroke
