#pragma once

#include <string>

#include "cli/print_text.h"

namespace sandstroke {

/// Prints a line of a summary. Names and values line up.
inline void print_row(const char* name, const std::string& value) {
  print_text("{:<18} {}\n", name, terminal_line(value));
}

}  // namespace sandstroke
