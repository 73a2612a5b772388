#pragma once

#include <filesystem>
#include <memory>

#include "io/height_map.h"

namespace sandstroke {

/// Opens a 16-bit grayscale PNG: values from 0 (black) to 1 (white), value / 65535 exactly; its upper border
/// is the largest y. Error: input, also for other kinds of PNG; io.
std::unique_ptr<HeightMap> open_png_map(const std::filesystem::path& path);

}  // namespace sandstroke
