#pragma once

#include <spdlog/fmt/fmt.h>

#include <string>

namespace sandstroke {

/// A line of a summary: its names and values line up.
inline void print_row(const char* name, const std::string& value) { fmt::print("{:<18} {}\n", name, value); }

}  // namespace sandstroke
