#include "sweep/thumbnail.h"

#include <algorithm>

#include "render/plain_map.h"
#include "sweep/kept_surface.h"

namespace sandstroke {

Image surface_thumbnail(const std::filesystem::path& point_file, double span) {
  const HeightGrid heights = coarse_surface(point_file, thumbnail_width);
  const auto rows = static_cast<int>(heights.rows()), cols = static_cast<int>(heights.cols());
  const int pixels = thumbnail_width / std::max(rows, cols);  // per block; 1 unless the bed has few cells
  return plain_map(heights, -span, span, ColourScale::diverging, pixels * cols, pixels * rows);
}

}  // namespace sandstroke
