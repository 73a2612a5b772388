#pragma once

#include <spdlog/fmt/fmt.h>

#include <utility>

#include "core/terminal_text.h"

namespace sandstroke {

/// Prints lines for people on the standard output. Nothing in them controls the terminal.
template <class... Args>
void print_text(fmt::format_string<Args...> format, Args&&... args) {
  fmt::print("{}", terminal_text(fmt::format(format, std::forward<Args>(args)...)));
}

}  // namespace sandstroke
