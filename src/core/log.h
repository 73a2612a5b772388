#pragma once

namespace sandstroke {

/// Human text goes to stderr (stdout is for results and --json): plain lines, warnings marked.
/// verbosity: 0 warnings only, 1 the usual, 2 debug.
void start_log(int verbosity);

}  // namespace sandstroke
