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

bool is_one_of(std::initializer_list<int> codes, int code) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

/// True for M words that a message or a file's name always follows.
bool is_followed_by_text(int m) { return is_one_of({160, 230, 280, 320, 330, 1170, 1180, 9280}, m); }

/// True for M words of RS-274 and of controls like it, which leave coordinates, F and S to the line's motion
/// and spindle. Others (of Marlin, Klipper, RepRap) are commands of their own, with words of their own.
bool leaves_words_to_the_line(int m) {
  return (m >= 0 && m <= 140) || is_one_of({300, 600, 970, 980, 990}, m);
}

/// True if the last G word may have letters without a number: G28 X Y.
bool goes_home(const GcodeWords& words) {
  return !words.g.empty() && is_one_of({280, 281, 290, 300, 320, 330, 340, 1610, 1620}, words.g.back());
}

/// "SUB" of "O100SUB", "O<NAME>SUB"; empty for a number alone.
std::string control_of(std::string_view o_word) {
  std::string_view rest = o_word.substr(1);
  if (rest.starts_with('<'))
    cut_before(rest, '>');
  else
    rest.remove_prefix(std::min(rest.find_first_not_of("0123456789"), rest.size()));
  const auto is_letter = [](char c) { return c >= 'A' && c <= 'Z'; };
  const std::string word(rest.begin(), std::find_if_not(rest.begin(), rest.end(), is_letter));
  return word.size() > 1 ? word : "";
}

/// The name with which a line begins, if it is a macro's (of Klipper): three or more letters and _.
std::string macro_of(std::string_view line) {
  line = without_blanks(line);
  const auto is_of_name = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; };
  const auto end = std::find_if_not(line.begin(), line.end(), is_of_name);
  const auto digits_end = std::find_if_not(end, line.end(), [](char c) { return c >= '0' && c <= '9'; });
  const bool is_alone = digits_end == line.end() || *digits_end == ' ' || *digits_end == '\t';
  return end - line.begin() >= 3 && is_alone ? std::string(line.begin(), digits_end) : "";
}

/// The number of a G or M word, times 10.
int code_of(char letter, double number, std::string_view text, const std::string& location) {
  const double most = letter == 'G' ? 999.9 : 99999.0, code = 10.0 * number;
  if (!(number >= 0.0 && number <= most) || std::signbit(number) ||
      std::abs(code - std::round(code)) > 1e-6 * std::max(code, 1.0))
    throw_input_error(
        "{}: {}{} is no {} word, whose number is 0 to {:g} with at most one decimal; correct or remove it",
        location, letter, text, letter, std::floor(most));
  return static_cast<int>(std::lround(code));
}

}  // namespace

bool GcodeWords::has_any_of(std::string_view letters) const {
  return std::any_of(letters.begin(), letters.end(),
                     [this](char letter) { return (*this)[letter].has_value(); });
}

bool GcodeWords::has_g(int code) const { return std::find(g.begin(), g.end(), code) != g.end(); }

GcodeWords gcode_words(std::string_view line, const std::string& location) {
  GcodeWords words;
  const std::string bare = bare_gcode(line);
  if (bare.starts_with('O') && bare.find_first_of("<0123456789") == 1) words.control = control_of(bare);
  if (!words.control.empty()) return words;
  words.macro = macro_of(line.substr(0, line.find_first_of(";(*")));
  if (!words.macro.empty()) return words;
  words.may_be_skipped = without_blanks(line).starts_with('/');
  GcodeWords::Values* values = &words.value;
  for (std::string_view rest = bare; !rest.empty();) {
    const char letter = rest[0];
    rest.remove_prefix(rest.size() > 1 && rest[1] == '+' ? 2 : 1);
    double number = 0.0;
    const auto [end, failure] =
        std::from_chars(rest.data(), rest.data() + rest.size(), number, std::chars_format::fixed);
    const bool is_letter = letter >= 'A' && letter <= 'Z';
    if (!is_letter || failure != std::errc() || !std::isfinite(number)) {
      if (is_letter && goes_home(words) && (rest.empty() || (rest[0] >= 'A' && rest[0] <= 'Z'))) {
        words.axes += letter;
        continue;
      }
      if (words.m.empty())
        throw_input_error("{}: '{}' is not a word of G-code (a letter and a number); correct or remove it",
                          location, fmt::format("{}{}", letter, rest.substr(0, 20)));
      words.has_text = true;
      if (words.m.back() == 300) words.m.pop_back();  // Marlin deletes the file of that name
      return words;
    }
    const std::string_view text = rest.substr(0, static_cast<std::size_t>(end - rest.data()));
    rest.remove_prefix(text.size());
    if (letter == 'G') {
      words.g.push_back(code_of(letter, number, text, location));
      values = &words.value;
    } else if (letter == 'M') {
      const int code = code_of(letter, number, text, location);
      words.has_text = is_followed_by_text(code);
      if (words.has_text) return words;
      words.m.push_back(code);
      values = leaves_words_to_the_line(code) ? &words.value : &words.own;
    } else {
      std::optional<double>& value = (*values)[static_cast<std::size_t>(letter - 'A')];
      if (value && *value != number && values == &words.value &&
          std::string_view("XYZIJRF").find(letter) != std::string_view::npos)
        throw_input_error("{}: {} is given twice, as {:g} and {:g}; write two lines, or remove one", location,
                          letter, *value, number);
      value = number;
    }
  }
  return words;
}

std::string gcode_word_text(char letter, int code) { return fmt::format("{}{:g}", letter, code / 10.0); }

bool looks_like_gcode(std::string_view text) {
  while (!text.empty()) {
    std::string_view line = cut_line(text);
    if (line.find_first_of(",\t") != std::string_view::npos) continue;
    try {
      const GcodeWords words = gcode_words(line, "");
      const auto is_typical = [](int code) {
        return is_one_of({0, 10, 20, 30, 170, 200, 210, 280, 900, 910, 920}, code);
      };
      if (std::any_of(words.g.begin(), words.g.end(), is_typical)) return true;
    } catch (const Error&) {
    }
  }
  return false;
}

}  // namespace sandstroke
