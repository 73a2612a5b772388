#pragma once

#include <filesystem>

#include "picture/image.h"

namespace sandstroke {

inline constexpr int thumbnail_width = 192;  ///< pixels

/// Draws a map of a point's kept surface, no side longer than thumbnail_width. Colours go from blue at -span
/// to red at span [m] > 0. Error: io, input.
Image surface_thumbnail(const std::filesystem::path& point_file, double span);

}  // namespace sandstroke
