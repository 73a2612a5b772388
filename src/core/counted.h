#pragma once

#include <spdlog/fmt/fmt.h>

#include <string>

namespace sandstroke {

/// "1 point is", "3 points are".
inline std::string counted(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}", count, count == 1 ? noun + " is" : noun + "s are");
}

}  // namespace sandstroke
