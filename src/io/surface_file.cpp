#include "io/surface_file.h"

#include <spdlog/spdlog.h>

#include <cmath>

#include "core/error.h"
#include "core/input_file.h"
#include "hdf5/hdf5_file.h"
#include "io/height_map.h"
#include "io/input_kind.h"
#include "io/map_on_bed.h"
#include "io/png_file.h"
#include "io/run_file.h"
#include "sand/cell_means.h"

namespace sandstroke {
namespace {

/// Error: input, for files that are neither maps nor HDF5 files.
void check_is_run(const std::filesystem::path& path) {
  if (begins_with(path, hdf5_signature)) return;
  expect_kind(path, {InputKind::run});
  throw_input_error(
      "{}: is neither a run file nor a map that sandstroke reads; save the heights as a GeoTIFF, a 16-bit "
      "grayscale PNG, a NumPy array (.npy) or an ESRI ASCII grid (.asc)",
      path.string());
}

/// A run's last surface: area means of it, if the bed has other cells.
HeightGrid last_heights(const RunFile& run, const BedSettings& bed) {
  const double width = run.cell_size() * run.cols(), depth = run.cell_size() * run.rows();
  if (std::abs(width - bed.width) > 1e-9 * bed.width || std::abs(depth - bed.depth) > 1e-9 * bed.depth)
    throw_input_error("{}: is a bed of {} x {} cells, {} m by {} m, but bed.size = [{}, {}]; make them equal",
                      run.name(), run.cols(), run.rows(), width, depth, bed.width, bed.depth);
  const SurfaceSettings& surface = bed.surface;
  if (surface.low != surface.high || surface.scale != 1.0 || surface.nodata)
    spdlog::info(
        "{}: is a run file, whose heights stay: bed.surface.low, high, scale and nodata are for maps",
        run.name());
  const bool same_cells = run.rows() == bed.rows && run.cols() == bed.cols;
  if (same_cells && run.has_final()) return run.final();
  const LastSurface last = last_surface(run);
  if (!run.has_final())
    spdlog::warn("{}: the run was cut off; the bed begins with its {}", run.name(), last.name);
  if (same_cells) return last.surface.grid();
  spdlog::info("{}: {} x {} cells fitted to {} x {} cells of {:.4g} m", run.name(), run.cols(), run.rows(),
               bed.cols, bed.rows, bed.cell_size());
  return HeightGrid::NullaryExpr(bed.rows, bed.cols, CellMeans(last.surface, bed.rows, bed.cols));
}

}  // namespace

namespace {

/// Warns, for a bed without a floor, if its file is a run with one.
void warn_of_lost_floor(const BedSettings& bed, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / bed.surface.file;
  if (bed.surface.kind != SurfaceKind::file || !begins_with(path, hdf5_signature) || !RunFile(path).ground())
    return;
  spdlog::warn(
      "{}: has stones or a floor, and this scene has none, so that they are sand here; give the scene the "
      "same "
      "ones, which 'sandstroke info --scene' prints",
      path.string());
}

}  // namespace

HeightField load_bed(const Scene& scene, const std::filesystem::path& folder) {
  HeightField bed = on_ground(load_surface(scene.bed, folder), scene);
  if (!has_floor(bed)) warn_of_lost_floor(scene.bed, folder);
  return bed;
}

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
  if (const std::unique_ptr<HeightMap> map = open_height_map(path)) {
    heights = heights_on_bed(*map, bed, path.string());
  } else {
    check_is_run(path);
    heights = last_heights(RunFile(path), bed);
    if (!heights.isFinite().all())
      throw_input_error("{}: holds heights that are not finite numbers; correct it", path.string());
  }
  return HeightField(heights, bed.cell_size(), bed.shape);
}

}  // namespace sandstroke
