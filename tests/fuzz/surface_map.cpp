// A map that a bed begins as, or that has its talus angles: an ESRI ASCII grid, a NumPy array, a TIFF or a
// PNG.
#include <fstream>

#include "core/temporary_folder.h"
#include "fuzz.h"
#include "io/sand_map_file.h"
#include "io/surface_file.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  std::ofstream(folder / "map", std::ios::binary) << as_text(data, size);
  BedSettings bed;
  bed.width = bed.depth = 0.08;
  bed.cols = bed.rows = 8;
  bed.surface.kind = SurfaceKind::file;
  bed.surface.file = "map";
  SandMap angles;
  angles.file = "map";
  // As it is, and with all that a scene may say about it.
  for (const bool filled : {false, true}) {
    if (filled) {
      bed.surface.nodata = 0.01;
      bed.surface.high = 0.02;
      angles.nodata = 30.0;
      angles.low = 20.0;
      angles.high = 40.0;
    }
    try_input([&] {
      const HeightGrid heights = load_surface(bed, folder.path()).grid();
      require(heights.isFinite().all() && heights.abs().maxCoeff() <= 0.8);
    });
    try_input([&] {
      GroundSettings ground;
      ground.map = angles;
      const HeightGrid slopes = *with_sand_map(ground, bed, folder.path()).map->slopes;
      require(slopes.isFinite().all() && slopes.minCoeff() >= 0.0);
    });
  }
  return 0;
}
