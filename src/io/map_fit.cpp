#include "io/map_fit.h"

#include <algorithm>

#include "core/error.h"

namespace sandstroke {

MapFit fit_on_bed(const MapLayout& map, const BedSettings& bed, std::optional<double> scale,
                  const std::string& name) {
  const Eigen::Vector2d cells(map.cols, map.rows), wanted(bed.width, bed.depth);
  // Without a size of its own the map is as wide as the bed.
  const Eigen::Vector2d own = map.cell ? Eigen::Vector2d(cells.cwiseProduct(*map.cell))
                                       : Eigen::Vector2d(cells * (bed.width / map.cols));
  const double right_scale = bed.width / own.x();
  const Eigen::Vector2d right_size = right_scale * own,
                        size = !map.cell ? own : Eigen::Vector2d(scale.value_or(right_scale) * own);
  const auto fits = [&](const Eigen::Vector2d& placed) {
    const double tolerance = 0.5 * std::min(bed.cell_size(), placed.cwiseQuotient(cells).minCoeff());
    return ((placed - wanted).array().abs() <= tolerance).all();
  };
  if (!fits(size)) {
    if (!map.cell || !fits(right_size))
      throw_input_error(
          "{}: has {} x {} cells{}, which a bed of {} m by {} m cannot have without distortion; cut the map, "
          "or set bed.size = [{}, {:.6g}]{} and bed.cells so that cells are square",
          name, map.cols, map.rows,
          map.cell ? fmt::format(" of {:g} x {:g} m", map.cell->x(), map.cell->y()) : "", bed.width,
          bed.depth, bed.width, right_size.y(),
          map.cell && scale ? fmt::format(", bed.surface.scale = {:.9g}", right_scale) : "");
    throw_input_error(
        "{}: is {:g} m by {:g} m{}, but the bed is {} m by {} m; set bed.surface.scale = {:.9g}, which "
        "scales lengths and heights, or bed.size = [{:g}, {:g}]",
        name, size.x(), size.y(), *scale == 1.0 ? "" : fmt::format(" at bed.surface.scale = {}", *scale),
        bed.width, bed.depth, right_scale, size.x(), size.y());
  }
  const double off = (size.cwiseQuotient(wanted).array() - 1.0).abs().maxCoeff();  // how much it is stretched
  const bool same_cells = map.rows == bed.rows && map.cols == bed.cols,
             scaled = map.cell && (scale ? *scale != 1.0 : std::abs(right_scale - 1.0) >= 1e-9);
  MapFit fit{same_cells && !scaled && off < 1e-9, fmt::format("{} x {} cells", map.cols, map.rows)};
  if (map.cell) fit.text += fmt::format(" of {:.4g} m", map.cell->x());
  if (fit.as_it_is) return fit;
  fit.text += fmt::format(" fitted to {} x {} cells of {:.4g} m", bed.cols, bed.rows, bed.cell_size());
  if (scaled && scale) fit.text += fmt::format(" at scale {:g}", *scale);
  if (off >= 1e-9) fit.text += fmt::format(", stretched by {:.2g} %", 100.0 * off);
  return fit;
}

HeightGrid upright(const HeightGrid& lines, const MapLayout& map) {
  HeightGrid grid = lines;
  if (map.by_columns) grid = lines.transpose();
  if (map.from_top) grid = grid.colwise().reverse().eval();
  return grid;
}

}  // namespace sandstroke
