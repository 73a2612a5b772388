#pragma once

#include <bit>
#include <cstdint>

#include "sand/height_field.h"

namespace sandstroke {

/// A cell of a bed, and by how much it changed [m].
struct SandChange {
  std::int32_t row = 0, col = 0;
  double change = 0.0;
};

/// A bed of which another thread has a replica. Each thread changes its own bed and tells the other by how
/// much. Changes are added, so their order does not matter: the two beds are the same (to rounding) whenever
/// all changes have been told and taken. Neither thread ever waits for the other, and no sand is lost.
class BedReplica {
 public:
  /// Allocates all tiles: later calls take no memory.
  explicit BedReplica(const HeightField& bed);

  HeightField& bed() { return bed_; }
  const HeightField& bed() const { return bed_; }

  /// Adds a change of sand that the other thread displaced. The next relaxation looks at this cell.
  void take_displaced(const SandChange& change);
  /// Adds a change of sand that the other thread relaxed.
  void take_relaxed(const SandChange& change);

  /// Calls tell(SandChange) for every cell that was disturbed here (HeightField::set, displacement), and
  /// clears the list of disturbed cells.
  template <class Tell>
  void tell_disturbed(const Tell& tell);
  /// The same for every cell that changed at all (relaxation); looks at whole tiles.
  template <class Tell>
  void tell_changed(const Tell& tell);

 private:
  struct Cell {
    int slot, row_in_tile, col_in_tile;
  };
  /// Adds a change to both beds, and says to which cell.
  Cell add(const SandChange& change);
  /// Tells of one cell unless the other thread knows its height.
  template <class Tell>
  void tell_cell(int slot, int row_in_tile, int col_in_tile, const Tell& tell) {
    const int at = row_in_tile * HeightField::tile_side + col_in_tile;
    double& known = known_.tile_heights(slot)[at];
    const double height = bed_.tile_heights(slot)[at];
    if (height == known) return;
    const CellRange cells = bed_.tile_cells(bed_.tile_of(slot));
    tell(SandChange{cells.row_begin + row_in_tile, cells.col_begin + col_in_tile, height - known});
    known = height;
  }

  HeightField bed_, known_;                    // known_: what the other thread has been told; the same slots
  std::vector<std::uint64_t> told_revisions_;  // by slot
};

template <class Tell>
void BedReplica::tell_disturbed(const Tell& tell) {
  for (const int slot : bed_.disturbed_tiles()) {
    const CellFlags& cells = bed_.disturbed_cells(slot);
    for (int row = 0; row < HeightField::tile_side; ++row)
      for (std::uint64_t left = cells[row]; left != 0; left &= left - 1)
        tell_cell(slot, row, std::countr_zero(left), tell);
    told_revisions_[slot] = bed_.tile_revision(bed_.tile_of(slot));
  }
  bed_.clear_disturbed();
}

template <class Tell>
void BedReplica::tell_changed(const Tell& tell) {
  for (int slot = 0; slot < bed_.allocated_tiles(); ++slot) {
    const std::uint64_t revision = bed_.tile_revision(bed_.tile_of(slot));
    if (revision == told_revisions_[slot]) continue;
    const CellRange cells = bed_.tile_cells(bed_.tile_of(slot));
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) tell_cell(slot, row, col, tell);
    told_revisions_[slot] = revision;
  }
}

}  // namespace sandstroke
