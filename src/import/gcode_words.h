#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sandstroke {

/// The words of one line of G-code.
struct GcodeWords {
  using Values = std::array<std::optional<double>, 26>;  ///< by letter

  std::vector<int> g, m;  ///< numbers times 10, in their order: G90.1 is 901
  Values value = {};      ///< of the motion, the spindle and the line: X, F, S
  /// Those of an M word that is none of RS-274's, and stands before them: X and Y in "M201 X500 Y500", S in
  /// "M280 S90". They move nothing.
  Values own = {};
  std::string axes;     ///< letters without a number, as home has them: "G28 X Y"
  std::string control;  ///< of an O word: "SUB", "CALL", "IF"; empty: none, or only a program's number
  std::string macro;    ///< the name of a command such as "START_PRINT", which is no word; the rest is empty
  bool may_be_skipped = false;  ///< the line begins with /, which some controls leave out
  bool has_text = false;        ///< text follows an M word, as in "M117 Hello"

  const std::optional<double>& operator[](char letter) const { return of(value, letter); }
  bool has_any_of(std::string_view letters) const;
  bool has_g(int code) const;

  static const std::optional<double>& of(const Values& values, char letter) {
    return values[static_cast<std::size_t>(letter - 'A')];
  }
};

/// The words of a line, without comments, checksum, blanks and commands to the machine ($H). Error: input;
/// `location` is the file and line.
GcodeWords gcode_words(std::string_view line, const std::string& location);

/// "G28.1", of a number times 10.
std::string gcode_word_text(char letter, int code);

/// True if a text looks like G-code: some line has a G word of motion, units or coordinates.
bool looks_like_gcode(std::string_view text);

}  // namespace sandstroke
