#include "io/surface_file.h"

#include <cmath>

#include "core/error.h"
#include "io/png_file.h"
#include "io/run_file.h"

namespace sandstroke {

BedSettings with_own_range(BedSettings bed, const std::filesystem::path& folder) {
  SurfaceSettings& surface = bed.surface;
  if (surface.kind != SurfaceKind::file || !has_picture_name(surface.file) || surface.low != surface.high)
    return bed;
  if (const std::optional<GrayRange> own = read_gray_range(folder / surface.file)) {
    surface.low = own->black;
    surface.high = own->white;
  }
  return bed;
}

HeightField load_surface(const BedSettings& settings, const std::filesystem::path& folder) {
  const BedSettings bed = with_own_range(settings, folder);
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
          "{}: the PNG does not say its heights, and bed.surface.low and high are both {} m; set them to the "
          "heights of black and white",
          path.string(), surface.low);
    const HeightGrid gray = read_height_png(path);
    heights = (gray == 1.0).select(surface.high, surface.low + (surface.high - surface.low) * gray);
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
  return HeightField(heights, bed.cell_size(), bed.shape);
}

}  // namespace sandstroke
