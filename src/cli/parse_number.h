#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace sandstroke {

/// Reads a number. True if the whole text is such a number.
template <class Number>
bool parse_number(std::string_view text, Number& number) {
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  return failure == std::errc() && end == text.data() + text.size();
}

}  // namespace sandstroke
