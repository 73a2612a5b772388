#pragma once

#include <filesystem>
#include <memory>

#include "io/height_map.h"

namespace sandstroke {

/// Opens a TIFF with one value per pixel: floats, or whole numbers of 16 or 32 bits. They are heights [m];
/// only if numbers without a sign have no size of a pixel, they are gray from 0 to the largest number. Its
/// upper border is the largest y. Read are the tags of GeoTIFF and GDAL for the pixels' size, units and no
/// data. Error: input, also for what would be taken wrongly (degrees, feet, a rotated map, a mask, scaled
/// numbers, several pictures); io.
std::unique_ptr<HeightMap> open_tiff_map(const std::filesystem::path& path);

}  // namespace sandstroke
