#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "sand/cell_flags.h"
#include "sand/height_field.h"

namespace sandstroke {

/// Numbers for the cells of a tile and a rim of two around them. Row r of the tile (-2 ... tile_side + 1)
/// begins with column 0 on a 64-byte boundary.
struct PatchLayout {
  static constexpr int side = BedGeometry::tile_side;
  static constexpr int rim = 2;  ///< a neighbour one cell away gives inflow, and depends on one cell further
  static constexpr int margin = cells_per_group;  ///< doubles before column 0 and after the last
  static constexpr int stride = side + 2 * margin;
  static constexpr int size = (side + 2 * rim) * stride + 2 * margin;  // vectors reach beyond the margins
  static int start(int row) { return margin + (row + rim) * stride + margin; }
};

/// Heights [m] in this layout; NaN at first.
class PatchHeights : public PatchLayout {
 public:
  PatchHeights();
  double* row(int r) { return values_.data() + start(r); }
  const double* row(int r) const { return values_.data() + start(r); }
  void fill(double height) { values_.fill(height); }

 private:
  alignas(64) std::array<double, size> values_;
};

/// The working copy of a tile in one relaxation: its heights, which the passes change, and a rim of two cells
/// around them. Cells outside the bed, in tiles that do not exist, and walls are NaN: every comparison with
/// them is false.
class TilePatch : public PatchLayout {
 public:
  /// Becomes the copy of another tile, with nothing loaded yet.
  void begin(int slot) {
    slot_ = slot;
    loaded_ = {};
  }
  int slot() const { return slot_; }

  /// Loads the tile's own rows within `rows`, except those that are loaded already.
  void load_rows(const HeightField& bed, RowSpan rows);
  /// Copies the rim beside the rows: to the west or the east if asked, and above and below the tile if `rows`
  /// reaches there. patch_of(slot): the copy of another tile, or null. That copy must have loaded all its
  /// rows that differ from the bed.
  template <class PatchOf>
  void load_rim(const HeightField& bed, RowSpan rows, bool west, bool east, const PatchOf& patch_of);
  /// Becomes the copy of a tile of the bed with its whole rim.
  void load_whole(const HeightField& bed, int slot);
  /// Writes the flagged cells' heights to the bed, except in walls.
  void write_back(HeightField& bed, const CellFlags& cells) const;

  double* heights(int row) { return heights_->row(row); }
  const double* heights(int row) const { return std::as_const(*heights_).row(row); }
  RowSpan loaded_rows() const { return loaded_; }  ///< rows of the tile itself
  /// Swaps the heights for others, which must hold the tile's own loaded rows.
  void exchange(std::unique_ptr<PatchHeights>& heights) { heights_.swap(heights); }

 private:
  /// Copies columns [first, last) of a row of the bed's tile to `out`, walls as NaN.
  static void copy_cells(const HeightField& bed, int slot, int row, int first, int last, double* out);

  int slot_ = -1;
  RowSpan loaded_;
  std::unique_ptr<PatchHeights> heights_ = std::make_unique<PatchHeights>();
};

template <class PatchOf>
void TilePatch::load_rim(const HeightField& bed, RowSpan span, bool west, bool east,
                         const PatchOf& patch_of) {
  const int tile = bed.tile_of(slot_);
  for (int part = -1; part <= 1; ++part) {  // the tile row above, the tile's own, the one below
    const int begin = std::max(span.begin, part < 0 ? -rim : part * side);
    const int end = std::min(span.end, part > 0 ? side + rim : (part + 1) * side);
    if (begin >= end) continue;
    for (int col_part = -1; col_part <= 1; ++col_part) {
      if ((col_part < 0 && !west) || (col_part > 0 && !east) || (part == 0 && col_part == 0)) continue;
      const int first = col_part < 0 ? side - rim : 0, last = col_part > 0 ? rim : side;
      const int beside = bed.tile_beside(tile, part, col_part);
      const int other = beside < 0 ? -1 : bed.slot_of(beside);
      const TilePatch* patch = other < 0 ? nullptr : patch_of(other);
      for (int row = begin; row < end; ++row) {
        double* out = heights(row) + col_part * side;
        const int there = row - part * side;
        if (patch && there >= patch->loaded_.begin && there < patch->loaded_.end)
          std::copy(patch->heights(there) + first, patch->heights(there) + last, out + first);
        else
          copy_cells(bed, other, there, first, last, out);
      }
    }
  }
}

}  // namespace sandstroke
