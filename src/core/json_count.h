#pragma once

#include <cstdint>
#include <limits>
#include <utility>

namespace sandstroke {

/// Reads a whole number from 0 to `most` from nlohmann's JSON, which itself would cast any number to any
/// other. Error: nlohmann's own.
template <class Count, class Json>
Count json_count(const Json& value, std::int64_t most = std::numeric_limits<std::int64_t>::max()) {
  const std::int64_t number = value.template get_ref<const typename Json::number_integer_t&>();
  if (number < 0 || number > most || !std::in_range<Count>(number))
    throw Json::out_of_range::create(406, "not a valid count", &value);
  return static_cast<Count>(number);
}

}  // namespace sandstroke
