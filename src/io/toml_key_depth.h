#pragma once

#include <string>
#include <string_view>

namespace sandstroke {

/// To be asked before a text is parsed as TOML: toml++ bounds how deep arrays and inline tables are nested
/// (256), but version 3.3 not what dotted keys make, and taking that apart overflows the stack. Error: input,
/// with file and line, where a key has over 16 parts.
void check_key_depth(std::string_view text, const std::string& name);

}  // namespace sandstroke
