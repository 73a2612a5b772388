#pragma once

#include <filesystem>

#include "sand/height_field.h"

namespace sandstroke {

/// A summary of a point's kept surface, which need not be held in memory.
struct KeptSurface {
  BedGeometry bed;
  double highest = 0.0;  ///< m, largest finite |height|
  std::string
      hash;  ///< of shape, cell size and heights; the same whether parts at the level were written or not
  std::filesystem::path file;  ///< that holds it
};

/// Reads /surface of a point's file. Error: io, input, if it is missing or cannot be read.
KeptSurface inspect_surface(const std::filesystem::path& point_file);

/// Reads the surface's heights [m] in square blocks of cells, at most `most` along a side. Each block has the
/// height of its cell furthest from the bed's commonest level, so that a furrow narrower than a block stays
/// visible.
HeightGrid coarse_surface(const std::filesystem::path& point_file, int most);

}  // namespace sandstroke
