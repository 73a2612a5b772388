#pragma once

#include <string>

namespace sandstroke {

/// Sends text for people to stderr: plain lines, warnings marked. stdout is for results and --json. quiet:
/// warnings only.
void start_log(bool quiet);

/// Warns, unless the sentence is empty.
void warn_if_any(const std::string& sentence);

}  // namespace sandstroke
