#pragma once

#include <string>

#include "import/gcode_words.h"

namespace sandstroke {

/// What a G word does to the path.
enum class GcodeRole {
  read,        ///< the reader follows it: motion, plane, units, distances, offsets
  keeps_path,  ///< does not change it: G40, G64, G98
  waits,       ///< takes the other words of its line, and nothing moves: G4
  goes_home,   ///< the tool goes where only the machine knows: G28, G53
  calls,       ///< calls a subprogram: G65
};

/// The role of a G word (its number times 10) in its line. Error: input, if it would change the path in a way
/// that is not read, for some words only once a path has begun; `location` is the file and line.
GcodeRole role_of_g(int code, const GcodeWords& words, bool path_has_begun, const std::string& location);

}  // namespace sandstroke
