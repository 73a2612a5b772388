#pragma once

#include <string_view>

#include "core/error.h"

namespace sandstroke {

/// Refuses a task that this program was built without, by this option of CMake. Error: input.
[[noreturn]] inline void throw_left_out(std::string_view task, std::string_view option) {
  throw_input_error(
      "{}: this sandstroke was built without this part (sandstroke --version lists what it is without); "
      "build one with cmake -D{}=ON, which names missing packages",
      task, option);
}

}  // namespace sandstroke
