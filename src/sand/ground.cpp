#include "sand/ground.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace sandstroke {
namespace {

HeightField level_field(const BedGeometry& bed, double value) {
  return HeightField(bed.rows(), bed.cols(), bed.cell_size(), std::make_shared<LevelRule>(value));
}

}  // namespace

Ground::Ground(const BedGeometry& bed, double talus_slope)
    : Ground(bed, -std::numeric_limits<double>::infinity(), talus_slope) {}

Ground::Ground(const BedGeometry& bed, double floor_level, double talus_slope)
    : floor(level_field(bed, floor_level)), talus_slopes(level_field(bed, talus_slope)) {}

Ground::Ground(HeightField floor_field, HeightField slopes)
    : floor(std::move(floor_field)), talus_slopes(std::move(slopes)) {}

double Ground::flattest() const {
  double least = talus_slopes.untouched().highest();
  for (int slot = 0; slot < talus_slopes.allocated_tiles(); ++slot) {
    const CellRange cells = talus_slopes.tile_cells(talus_slopes.tile_of(slot));
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col)
        least = std::min(least, talus_slopes.tile_heights(slot)[row * HeightField::tile_side + col]);
  }
  return least;
}

bool Ground::is_allocated_around(const HeightField& field, int tile) {
  for (int row_step = -1; row_step <= 1; ++row_step)
    for (int col_step = -1; col_step <= 1; ++col_step) {
      const int beside = field.tile_beside(tile, row_step, col_step);
      if (beside >= 0 && field.slot_of(beside) >= 0) return true;
    }
  return false;
}

TalusGround talus_ground(const Ground& ground) {
  return {ground.talus_slopes.grid() * ground.talus_slopes.cell_size(), ground.floor.grid()};
}

std::string content_hash(const Ground& ground) {
  return content_hash(ground.floor) + content_hash(ground.talus_slopes);
}

bool has_floor(const HeightField& bed) { return bed.ground() && bed.ground()->has_floor(); }

}  // namespace sandstroke
