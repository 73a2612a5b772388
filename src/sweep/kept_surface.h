#pragma once

#include <filesystem>

#include "sand/height_field.h"

namespace sandstroke {

/// What there is to know of a point's kept surface without holding it in memory.
struct KeptSurface {
  BedGeometry bed;
  double highest = 0.0;  ///< m, largest |height| that is finite
  std::string
      hash;  ///< of its shape, cell size and heights; whether parts at its level were written does not matter
};

/// /surface of a point's file. Error: io, input, where it is not there or cannot be read.
KeptSurface inspect_surface(const std::filesystem::path& point_file);

/// Its heights [m] in square blocks of cells, at most `most` along a side: of each block the cell furthest
/// from the bed's commonest level, so that a furrow narrower than a block does not fade among its ramparts.
HeightGrid coarse_surface(const std::filesystem::path& point_file, int most);

}  // namespace sandstroke
