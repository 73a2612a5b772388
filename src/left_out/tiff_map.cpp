// Instead of io/tiff_map.cpp, which needs libtiff (SANDSTROKE_IMPORT=OFF).
#include "io/tiff_map.h"

#include "left_out/left_out.h"

namespace sandstroke {

std::unique_ptr<HeightMap> open_tiff_map(const std::filesystem::path& path) {
  throw_left_out(path.string() + ": reading TIFF", "SANDSTROKE_IMPORT");
}

}  // namespace sandstroke
