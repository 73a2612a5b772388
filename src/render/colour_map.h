#pragma once

#include <array>

#include "picture/image.h"

namespace sandstroke {

/// Perceptually even map (viridis), dark blue at 0 to yellow at 1. Returns sRGB in [0, 1]; clamps, NaN is
/// grey.
std::array<double, 3> sequential_colour(double unit);

/// Blue at -1, near white at 0, red at 1 (ColorBrewer RdBu). Returns sRGB in [0, 1]; clamps, NaN is grey.
std::array<double, 3> diverging_colour(double minus_one_to_one);

/// The kinds of colour scales. sequential: of sequential_colour(). diverging: of diverging_colour(), white in
/// the middle.
enum class ColourScale { sequential, diverging };

/// The colour of `value` on the scale from low to high.
std::array<double, 3> scale_colour(double value, double low, double high, ColourScale scale);

/// A colour given in [0, 1] as the bytes of an image.
Rgb as_bytes(const std::array<double, 3>& colour);

}  // namespace sandstroke
