#pragma once

#include <string>

namespace sandstroke {

/// Human text goes to stderr (stdout is for results and --json): plain lines, warnings marked.
/// quiet: warnings only.
void start_log(bool quiet);

/// Nothing where the sentence is empty.
void warn_if_any(const std::string& sentence);

}  // namespace sandstroke
