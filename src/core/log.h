#pragma once

namespace sandstroke {

/// Human text goes to stderr (stdout is for results and --json): plain lines, warnings marked.
/// quiet: warnings only.
void start_log(bool quiet);

}  // namespace sandstroke
