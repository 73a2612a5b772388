#pragma once

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>

namespace sandstroke {

/// One JSON object on the standard output, in ASCII: no name in it controls a terminal. Names of files may be
/// no UTF-8: what is not is replaced.
template <class Json>
void print_json(const Json& json) {
  fmt::print("{}\n", json.dump(2, ' ', true, Json::error_handler_t::replace));
}

}  // namespace sandstroke
