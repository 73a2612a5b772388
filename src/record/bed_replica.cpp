#include "record/bed_replica.h"

namespace sandstroke {
namespace {

HeightField with_all_tiles(HeightField bed) {
  for (int tile = 0; tile < bed.tile_count(); ++tile) bed.allocate(tile);
  return bed;
}

}  // namespace

BedReplica::BedReplica(const HeightField& bed) : bed_(with_all_tiles(bed)), known_(bed_) {
  // Gives the list of disturbed tiles its memory, and both beds tiles of their own.
  for (int slot = 0; slot < bed_.allocated_tiles(); ++slot) {
    bed_.mark_disturbed(slot, 0, 0);
    known_.mark_changed(slot);
  }
  bed_.clear_disturbed();
  for (int slot = 0; slot < bed_.allocated_tiles(); ++slot)
    told_revisions_.push_back(bed_.tile_revision(bed_.tile_of(slot)));
}

BedReplica::Cell BedReplica::add(const SandChange& change) {
  constexpr int side = HeightField::tile_side;
  const int slot = bed_.slot_of(bed_.tile_index(change.row / side, change.col / side));
  const int row = change.row % side, col = change.col % side;
  const int at = row * side + col;
  bed_.tile_heights(slot)[at] += change.change;
  known_.tile_heights(slot)[at] += change.change;
  return {slot, row, col};
}

void BedReplica::take_displaced(const SandChange& change) {
  const Cell cell = add(change);
  bed_.mark_disturbed(cell.slot, cell.row_in_tile, std::uint64_t{1} << cell.col_in_tile);
}

void BedReplica::take_relaxed(const SandChange& change) { bed_.mark_changed(add(change).slot); }

}  // namespace sandstroke
