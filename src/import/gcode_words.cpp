#include "import/gcode_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

/// The G-code of a line, in capitals and without comments. A comment ends with its line.
std::string bare_gcode(std::string_view line) {
  std::string bare;
  bool in_comment = false;
  for (const char c : line) {
    if (in_comment) {
      in_comment = c != ')';
    } else if (c == '(') {
      in_comment = true;
    } else if (c == ';' || c == '*') {
      break;
    } else if (c >= 'a' && c <= 'z') {
      bare += static_cast<char>(c - 'a' + 'A');
    } else if (c != ' ' && c != '\t' && c != '\r') {
      bare += c;
    }
  }
  const bool for_the_machine = !bare.empty() && (bare[0] == '$' || bare[0] == '%');
  return for_the_machine ? "" : bare.substr(bare.starts_with('/') ? 1 : 0);
}

/// True for M words that a message or a file's name follows.
bool is_followed_by_text(double m) {
  const auto with_text = {16.0, 23.0, 28.0, 30.0, 32.0, 33.0, 117.0, 118.0, 928.0};
  return std::find(with_text.begin(), with_text.end(), m) != with_text.end();
}

}  // namespace

bool GcodeWords::has_any_of(std::string_view letters) const {
  return std::any_of(letters.begin(), letters.end(),
                     [this](char letter) { return (*this)[letter].has_value(); });
}

GcodeWords gcode_words(std::string_view line, const std::string& location) {
  GcodeWords words;
  const std::string bare = bare_gcode(line);
  for (std::string_view rest = bare; !rest.empty();) {
    const char letter = rest[0];
    rest.remove_prefix(rest.size() > 1 && rest[1] == '+' ? 2 : 1);
    double number = 0.0;
    const auto [end, failure] =
        std::from_chars(rest.data(), rest.data() + rest.size(), number, std::chars_format::fixed);
    if (letter < 'A' || letter > 'Z' || failure != std::errc() || !std::isfinite(number)) {
      if (!words.m.empty()) return words;  // M117 and others are followed by text
      throw_input_error("{}: '{}' is not a word of G-code (a letter and a number); correct or remove it",
                        location, fmt::format("{}{}", letter, rest.substr(0, 20)));
    }
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    if (letter == 'G' || letter == 'M') {
      const double code = std::clamp(number, 0.0, 1e6);
      if (letter == 'M' && is_followed_by_text(code)) return words;
      auto& codes = letter == 'G' ? words.g : words.m;
      codes.push_back(static_cast<int>(std::lround(10.0 * code)));
    } else {
      words.value[static_cast<std::size_t>(letter - 'A')] = number;
    }
  }
  return words;
}

bool looks_like_gcode(std::string_view text) {
  while (!text.empty()) {
    std::string_view line = cut_line(text);
    if (line.find_first_of(",\t") != std::string_view::npos) continue;
    try {
      const GcodeWords words = gcode_words(line, "");
      const auto typical = {0, 10, 20, 30, 170, 200, 210, 280, 900, 910, 920};
      const auto is_typical = [&](int code) {
        return std::find(typical.begin(), typical.end(), code) != typical.end();
      };
      if (std::any_of(words.g.begin(), words.g.end(), is_typical)) return true;
    } catch (const Error&) {
    }
  }
  return false;
}

}  // namespace sandstroke
