#pragma once

#include "picture/image.h"
#include "render/colour_map.h"
#include "sand/height_field.h"

namespace sandstroke {

/// A flat map of a grid seen from above (row 0 at the bottom), coloured from low to high [m] (low < high),
/// over width x height pixels. Each shows the mean of the cells it covers, or the cell it lies in. Cells that
/// are not finite are grey. Needs no graphics context.
Image plain_map(const HeightGrid& values, double low, double high, ColourScale scale, int width, int height);

}  // namespace sandstroke
