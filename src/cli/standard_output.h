#pragma once

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/terminal_text.h"

namespace sandstroke {

/// Prints lines for people on the standard output. Nothing in them controls the terminal.
template <class... Args>
void print_text(fmt::format_string<Args...> format, Args&&... args) {
  fmt::print("{}", terminal_text(fmt::format(format, std::forward<Args>(args)...)));
}

/// Prints a line of a summary. Names and values line up.
inline void print_row(const char* name, const std::string& value) {
  print_text("{:<18} {}\n", name, terminal_line(value));
}

/// Prints one JSON object on the standard output, in ASCII, so that no name in it controls a terminal.
/// Replaces bytes of file names that are not UTF-8.
template <class Json>
void print_json(const Json& json) {
  fmt::print("{}\n", json.dump(2, ' ', true, Json::error_handler_t::replace));
}

/// Reports that the standard output could not be written (errno `error`). Error: io. If its reader has gone,
/// as `head` does, the program ends quietly by SIGPIPE, as other programs do.
[[noreturn]] void throw_output_error(int error);

/// Flushes the standard output. Errors as above.
void flush_output();

}  // namespace sandstroke
