#pragma once

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace sandstroke {

/// "1 point is", "3 points are".
inline std::string counted(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}", count, count == 1 ? noun + " is" : noun + "s are");
}

/// The first `most` of these names, and how many are left: "a, b and 3 more".
inline std::string first_of(std::vector<std::string> names, std::size_t most) {
  const std::size_t more = names.size() - std::min(names.size(), most);
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace sandstroke
