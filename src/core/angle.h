#pragma once

#include <numbers>

namespace sandstroke {

constexpr double degree = std::numbers::pi / 180.0;  ///< rad

}  // namespace sandstroke
