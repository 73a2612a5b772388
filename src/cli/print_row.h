#pragma once

#include <string>

#include "cli/print_text.h"

namespace sandstroke {

/// A line of a summary: its names and values line up.
inline void print_row(const char* name, const std::string& value) {
  print_text("{:<18} {}\n", name, terminal_line(value));
}

}  // namespace sandstroke
