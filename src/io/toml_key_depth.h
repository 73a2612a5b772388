#pragma once

#include <string>
#include <string_view>

namespace sandstroke {

/// Call it before a text is parsed as TOML. toml++ limits how deep arrays and inline tables are nested (256),
/// but version 3.3 does not limit what dotted keys make, and destroying that overflows the stack. Error:
/// input, with file and line, if a key has over 16 parts.
void check_key_depth(std::string_view text, const std::string& name);

}  // namespace sandstroke
