#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

namespace sandstroke {

// Functions that take a text apart. Each cut_...() removes what it returns from the text.

/// The largest text from which samples are read at once [bytes].
inline constexpr std::size_t most_sample_text_bytes = 200'000'000;

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

inline std::string_view without_byte_order_mark(std::string_view text) {
  return text.substr(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
}

/// Without blanks at both ends.
inline std::string_view without_blanks(std::string_view text, std::string_view blanks = " \t\r\n\v\f") {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Cuts off the text up to a separator, or all of it.
inline std::string_view cut_before(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

/// Cuts off a line, without blanks at both ends.
inline std::string_view cut_line(std::string_view& text) { return without_blanks(cut_before(text, '\n')); }

/// Cuts off the next word between blanks or commas; empty if there is none.
inline std::string_view cut_word(std::string_view& text) {
  constexpr std::string_view between = " \t\r\n,";
  text.remove_prefix(std::min(text.find_first_not_of(between), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(between));
  text.remove_prefix(word.size());
  return word;
}

/// The number that is the whole text, if it is a finite number: "1.5", "+3", "-1e3".
inline std::optional<double> finite_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

}  // namespace sandstroke
