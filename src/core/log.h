#pragma once

namespace sandstroke {

/// Sends text for people to stderr: plain lines, warnings marked. stdout is for results and --json. quiet:
/// warnings only.
void start_log(bool quiet);

}  // namespace sandstroke
