#include "sim/sand_at_rest.h"

#include <array>

namespace sandstroke {

SandAtRest::SandAtRest(const HeightField& bed, std::unique_ptr<Relaxer> relaxer)
    : copy_(bed), relaxer_(std::move(relaxer)) {
  for (int slot = 0; slot < copy_.allocated_tiles(); ++slot)
    same_.push_back(revisions(bed, copy_.tile_of(slot)));
}

HeightField& SandAtRest::follow(const HeightField& bed) {
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot) copy_.allocate(bed.tile_of(slot));
  const auto known = same_.size();
  same_.resize(static_cast<std::size_t>(copy_.allocated_tiles()));
  for (std::size_t slot = 0; slot < same_.size(); ++slot) {
    const int tile = copy_.tile_of(static_cast<int>(slot));
    if (slot < known && same_[slot] == revisions(bed, tile)) continue;
    take_tile(bed, static_cast<int>(slot));
    same_[slot] = revisions(bed, tile);
  }
  return copy_;
}

void SandAtRest::take_tile(const HeightField& bed, int slot) {
  constexpr int side = HeightField::tile_side;
  std::array<double, HeightField::tile_area> heights;
  const int tile = copy_.tile_of(slot);
  bed.read_tile(tile, heights.data());
  const CellRange cells = copy_.tile_cells(tile);
  double* own = copy_.tile_heights(slot);
  for (int row = 0; row < cells.rows(); ++row) {
    std::uint64_t changed = 0;
    for (int col = 0; col < cells.cols(); ++col) {
      const int at = row * side + col;
      if (own[at] == heights[at]) continue;
      own[at] = heights[at];
      changed |= std::uint64_t{1} << col;
    }
    if (changed != 0) copy_.mark_disturbed(slot, row, changed);
  }
}

}  // namespace sandstroke
