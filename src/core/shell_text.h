#pragma once

#include <string>

namespace sandstroke {

/// Text as a shell takes it for one word: quoted where it must be.
std::string shell_quoted(const std::string& text);

}  // namespace sandstroke
