#include "sand/ground.h"

#include <limits>
#include <memory>

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

bool Ground::is_allocated_around(const HeightField& field, int tile) {
  for (int row_step = -1; row_step <= 1; ++row_step)
    for (int col_step = -1; col_step <= 1; ++col_step) {
      const int beside = field.tile_beside(tile, row_step, col_step);
      if (beside >= 0 && field.slot_of(beside) >= 0) return true;
    }
  return false;
}

}  // namespace sandstroke
