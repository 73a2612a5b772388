#pragma once

#include <string>

namespace sandstroke {

/// Quotes text, if it must be quoted, so that a shell takes it for one word.
std::string shell_quoted(const std::string& text);

}  // namespace sandstroke
