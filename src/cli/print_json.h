#pragma once

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>

#include "sim/run_result.h"

namespace sandstroke {

/// {"height_share": ..., ...}
inline nlohmann::ordered_json error_json(const ErrorEstimate& error) {
  nlohmann::ordered_json json;
  visit_error_fields([&](const FieldText& field, const auto& of) { json[field.name] = of(error); });
  return json;
}

/// One JSON object on the standard output, in ASCII: no name in it controls a terminal. Names of files may be
/// no UTF-8: what is not is replaced.
template <class Json>
void print_json(const Json& json) {
  fmt::print("{}\n", json.dump(2, ' ', true, Json::error_handler_t::replace));
}

}  // namespace sandstroke
