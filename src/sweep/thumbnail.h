#pragma once

#include <filesystem>

#include "picture/image.h"

namespace sandstroke {

inline constexpr int thumbnail_width = 192;  ///< pixels

/// A picture made so narrow, each pixel the mean of those it covers; one that is narrower stays as it is.
Image shrunk(const Image& picture, int width);

/// A map of the heights of a point's kept surface, no side longer than thumbnail_width: from blue at -span to
/// red at span [m] > 0. Error: io, input.
Image surface_thumbnail(const std::filesystem::path& point_file, double span);

}  // namespace sandstroke
