#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sandstroke {

/// The words of one line of G-code.
struct GcodeWords {
  std::vector<int> g, m;  ///< numbers times 10, in their order: G90.1 is 901
  std::array<std::optional<double>, 26> value;

  const std::optional<double>& operator[](char letter) const {
    return value[static_cast<std::size_t>(letter - 'A')];
  }
  bool has_any_of(std::string_view letters) const;
};

/// The words of a line, without comments, checksum, blanks and commands to the machine ($H). Error: input;
/// `location` is the file and line.
GcodeWords gcode_words(std::string_view line, const std::string& location);

/// True if a text looks like G-code: some line has a G word of motion, units or coordinates.
bool looks_like_gcode(std::string_view text);

}  // namespace sandstroke
