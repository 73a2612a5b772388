#include "io/surface_file.h"

#include <cmath>

#include "core/error.h"
#include "io/png_file.h"
#include "io/run_file.h"

namespace sandstroke {

HeightField load_surface(const BedSettings& bed, const std::filesystem::path& folder) {
  const SurfaceSettings& surface = bed.surface;
  if (surface.kind != SurfaceKind::file) return starting_bed(bed);

  const std::filesystem::path path = folder / surface.file;
  HeightGrid heights;
  const auto check_cells = [&](Eigen::Index rows, Eigen::Index cols) {
    if (rows != bed.rows || cols != bed.cols)
      throw_input_error("{}: has {} x {} cells (x, y), but bed.cells = [{}, {}]; make them equal",
                        path.string(), cols, rows, bed.cols, bed.rows);
  };
  if (has_picture_name(path)) {
    if (surface.low == surface.high)
      throw_input_error(
          "{}: bed.surface.low and high are both {} m; set them to the heights of black and white",
          path.string(), surface.low);
    heights = surface.low + (surface.high - surface.low) * read_height_png(path);
  } else {
    const RunFile run(path);
    check_cells(run.rows(), run.cols());  // before memory is taken for them
    heights = run.final();
    if (std::abs(run.cell_size() - bed.cell_size()) > 1e-9 * bed.cell_size())
      throw_input_error("{}: has cells of {} m, but the bed has cells of {} m; change bed.size or bed.cells",
                        path.string(), run.cell_size(), bed.cell_size());
  }
  check_cells(heights.rows(), heights.cols());
  if (!heights.isFinite().all())
    throw_input_error("{}: holds heights that are not finite numbers; correct it", path.string());
  return HeightField(heights, bed.cell_size());
}

}  // namespace sandstroke
