#pragma once

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>

namespace sandstroke {

/// Prints one JSON object on the standard output, in ASCII, so that no name in it controls a terminal.
/// Replaces bytes of file names that are not UTF-8.
template <class Json>
void print_json(const Json& json) {
  fmt::print("{}\n", json.dump(2, ' ', true, Json::error_handler_t::replace));
}

}  // namespace sandstroke
