#include "io/toml_key_depth.h"

#include <algorithm>

#include "core/error.h"

namespace sandstroke {
namespace {

constexpr int most_parts = 16;  // of a dotted key

/// The line of the first key with more parts; 0: none.
int line_of_too_deep_key(std::string_view text) {
  int line = 1, dots = 0;
  const auto skip = [&](std::size_t count) {
    line +=
        static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
    text.remove_prefix(count);
  };
  const auto skip_string = [&](std::string_view quote) {
    const bool escapes = quote.front() == '"', one_line = quote.size() == 1;
    std::size_t end = quote.size();
    while (end < text.size() && !text.substr(end).starts_with(quote) && !(one_line && text[end] == '\n'))
      end += escapes && text[end] == '\\' ? 2 : 1;
    end += quote.size();
    for (int i = 0; i < 2 && !one_line && end < text.size() && text[end] == quote.front(); ++i) ++end;
    skip(std::min(end, text.size()));
  };
  while (!text.empty()) {
    const char c = text.front();
    if (c == '"' || c == '\'') {
      const std::string three(3, c);
      skip_string(text.starts_with(three) ? three : three.substr(0, 1));
      continue;
    }
    if (c == '#') {
      skip(std::min(text.find('\n'), text.size()));
      continue;
    }
    if (c == '.' && ++dots == most_parts) return line;
    if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) dots = 0;
    skip(1);
  }
  return 0;
}

}  // namespace

void check_key_depth(std::string_view text, const std::string& name) {
  if (const int line = line_of_too_deep_key(text))
    throw_input_error("{}:{}: a key has more than {} parts; no setting has so many", name, line, most_parts);
}

}  // namespace sandstroke
