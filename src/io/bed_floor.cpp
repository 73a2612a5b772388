#include "io/bed_floor.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "io/bed_writer.h"

namespace sandstroke {
namespace {

constexpr double no_floor = -std::numeric_limits<double>::infinity();

}  // namespace

void write_floor(Hdf5GridWriter& file, const HeightField& floor) {
  write_bed(file, floor_dataset, floor);
  file.attach_scales(floor_dataset, {"/surface/y", "/surface/x"});
  file.describe(floor_dataset, "m", "height of the floor under the sand; not-a-number: there is none");
}

HeightField read_floor(const Hdf5Reader& file, const BedGeometry& bed) {
  const BedGeometry shape = file.bed_geometry(floor_dataset, bed.cell_size());
  if (!shape.same_grid(bed))
    throw_input_error("{}: {} and /surface/initial differ in shape; the file is damaged", file.name(),
                      floor_dataset);
  const auto floor_of = [&](double stored) {
    if (std::isinf(stored))
      throw_input_error("{}: {} has infinite heights; the file is damaged", file.name(), floor_dataset);
    return std::isnan(stored) ? no_floor : stored;
  };
  HeightField floor(bed.rows(), bed.cols(), bed.cell_size(),
                    std::make_shared<LevelRule>(floor_of(file.fill_value(floor_dataset))));
  file.visit_written(
      floor_dataset, [&](Eigen::Index first_row, Eigen::Index first_col, const HeightGrid& heights) {
        for (Eigen::Index r = 0; r < heights.rows(); ++r)
          for (Eigen::Index c = 0; c < heights.cols(); ++c) {
            const auto row = static_cast<int>(first_row + r), col = static_cast<int>(first_col + c);
            const double height = floor_of(heights(r, c));
            if (height != floor(row, col))
              floor.set(row, col, height);  // no tile where only the fill value is
          }
      });
  return floor;
}

void check_above_floor(const HeightField& surface, const HeightField& floor, const std::string& run_name) {
  std::array<double, BedGeometry::tile_area> height, lowest;
  for (int tile = 0; tile < floor.tile_count(); ++tile) {
    if (floor.slot_of(tile) < 0 && floor.untouched().highest() == no_floor) continue;
    floor.read_tile(tile, lowest.data());
    surface.read_tile(tile, height.data());
    const CellRange cells = floor.tile_cells(tile);
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) {
        const int at = row * BedGeometry::tile_side + col;
        if (height[at] < lowest[at])
          throw_input_error("{}: the sand is below {} at row {}, column {}; the file is damaged", run_name,
                            floor_dataset, cells.row_begin + row, cells.col_begin + col);
      }
  }
}

}  // namespace sandstroke
