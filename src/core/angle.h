#pragma once

#include <numbers>

namespace sandstroke {

constexpr double to_radians(double angle) { return angle * std::numbers::pi / 180.0; }
constexpr double to_degrees(double angle) { return angle * 180.0 / std::numbers::pi; }

}  // namespace sandstroke
