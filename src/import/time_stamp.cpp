#include "import/time_stamp.h"

#if defined(__GNUC__) && !defined(__clang__)  // gcc for arm64 warns wrongly of a buffer in it
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wstringop-overflow"
#include <date/date.h>
#pragma GCC diagnostic pop
#else
#include <date/date.h>
#endif

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "import/text_parts.h"

namespace sandstroke {
namespace {

template <class Value>
std::optional<Value> whole(std::string_view text) {
  Value value{};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// True if a text begins as `shape`, in which 0 stands for any digit, and 5 for one of 0 to 5.
bool has_shape(std::string_view text, std::string_view shape) {
  const auto fits = [](char one, char c) {
    if (one == '0') return c >= '0' && c <= '9';
    if (one == '5') return c >= '0' && c <= '5';
    return c == one;
  };
  return text.size() >= shape.size() && std::equal(shape.begin(), shape.end(), text.begin(), fits);
}

/// True if a text may stand behind the seconds: a fraction (".123456"), a zone ("+02:00"), both or neither.
bool is_fraction_and_zone(std::string_view text) {
  if (text.starts_with('.'))
    text.remove_prefix(std::min(text.find_first_not_of("0123456789", 1), text.size()));
  if (text.empty()) return true;
  const auto is_zone = [&](std::string_view shape) {
    return text.size() == shape.size() + 1 && has_shape(text.substr(1), shape);
  };
  return (text[0] == '+' || text[0] == '-') && (is_zone("00") || is_zone("0000") || is_zone("00:00"));
}

/// A date or time in nanoseconds. It must be the whole text.
template <class Time>
std::optional<std::int64_t> parsed(const std::string& text, const char* format) {
  std::istringstream stream(text);
  Time time{};
  stream >> date::parse(format, time);
  if (stream.fail() || stream.peek() != std::istringstream::traits_type::eof()) return std::nullopt;
  if constexpr (requires { time.time_since_epoch(); })
    return time.time_since_epoch().count();
  else
    return time.count();
}

}  // namespace

std::optional<std::int64_t> iso_time(std::string_view text) {
  if (text.size() < 7 || text.size() > 40 || text.find(':') == std::string_view::npos) return std::nullopt;
  std::string plain(text);
  std::replace(plain.begin(), plain.end(), ',', '.');
  if (plain.back() == 'Z') plain.pop_back();
  using Nanoseconds = std::chrono::nanoseconds;
  // Strict, because the library takes any number of digits for the seconds, any byte for a digit of the zone,
  // and 60 minutes in a time of day.
  const auto is_written_as = [&](std::string_view shape) {
    return has_shape(plain, shape) && is_fraction_and_zone(std::string_view(plain).substr(shape.size()));
  };
  if (is_written_as("00:50:50")) return parsed<Nanoseconds>(plain, "%T");
  if (plain.size() > 10) plain[10] = 'T';
  if (!is_written_as("0000-00-00T00:00:00")) return std::nullopt;
  const int year = whole<int>(std::string_view(plain).substr(0, 4)).value_or(0);
  if (year < 1700 || year > 2250) return std::nullopt;  // 64 bits do not hold the ns of other years
  using Time = date::sys_time<Nanoseconds>;
  const std::size_t zone = plain.find_first_of("+-", 11);
  if (zone == std::string::npos) return parsed<Time>(plain, "%FT%T");
  return parsed<Time>(plain, plain.find(':', zone) == std::string::npos ? "%FT%T%z" : "%FT%T%Ez");
}

std::optional<double> TimeStamps::read(std::string_view text) {
  if (kind_ == Kind::none) {
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    if (const auto time = iso_time(text)) {
      kind_ = Kind::iso;
      origin_ = *time;
    } else if (const auto first = whole<std::int64_t>(text.substr(0, digits)); first && digits > 9) {
      kind_ = Kind::clock;
      origin_ = *first;
    } else {
      kind_ = Kind::plain;
    }
  }
  if (kind_ == Kind::plain) return finite_number(text);
  // The difference of two 64-bit numbers may not fit into 64 bits.
  const auto since_first = [&](std::int64_t time) {
    std::int64_t difference = 0;
    if (__builtin_sub_overflow(time, origin_, &difference)) return std::optional<double>();
    return std::optional(static_cast<double>(difference));
  };
  if (kind_ == Kind::iso) {
    const auto time = iso_time(text);
    return time ? since_first(*time) : std::nullopt;
  }
  const std::size_t point = std::min(text.find('.'), text.size());
  if (const auto number = whole<std::int64_t>(text.substr(0, point))) {
    const std::string_view rest = text.substr(point);
    const auto fraction = rest.size() > 1 ? whole<double>(rest) : std::optional(0.0);
    const auto since = since_first(*number);
    if (fraction && since) return *since + (*number < 0 ? -*fraction : *fraction);
  }
  const auto number = finite_number(text);
  return number ? std::optional(*number - static_cast<double>(origin_)) : std::nullopt;
}

}  // namespace sandstroke
