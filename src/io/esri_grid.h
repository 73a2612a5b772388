#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "io/height_map.h"

namespace sandstroke {

/// True for a text that begins with a key of an ESRI ASCII grid's header.
bool begins_as_esri_grid(std::string_view text);

/// Opens an ESRI ASCII grid: keys ncols, nrows, cellsize (or dx and dy), NODATA_value (-9999 if it is not
/// given) in any order and case, then the heights from the largest y on. Where it lies is not used. Error:
/// input, naming the line; io.
std::unique_ptr<HeightMap> open_esri_grid(const std::filesystem::path& path);

}  // namespace sandstroke
