#include "sand/tile_patch.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace sandstroke {
namespace {

constexpr double wall = std::numeric_limits<double>::quiet_NaN();

}  // namespace

PatchHeights::PatchHeights() { values_.fill(wall); }

void TilePatch::copy_cells(const HeightField& bed, int slot, int row, int first, int last, double* out) {
  const CellRange inside = slot < 0 ? CellRange{} : bed.tile_cells(bed.tile_of(slot));
  const int until = row < inside.rows() ? std::clamp(inside.cols(), first, last) : first;
  std::fill(out + until, out + last, wall);
  if (first == until) return;
  const double* in = bed.tile_heights(slot) + row * side;
  std::copy(in + first, in + until, out + first);
  for (std::uint64_t walls = bed.walls(slot)[row] & columns_between(first, until); walls; walls &= walls - 1)
    out[std::countr_zero(walls)] = wall;
}

void TilePatch::load_rows(const HeightField& bed, RowSpan span) {
  const RowSpan wanted = {std::max(span.begin, 0), std::min(span.end, side)};
  const auto load = [&](int begin, int end) {
    for (int row = begin; row < end; ++row) copy_cells(bed, slot_, row, 0, side, heights(row));
  };
  if (loaded_.empty()) loaded_ = {wanted.begin, wanted.begin};
  load(wanted.begin, loaded_.begin);
  load(loaded_.end, wanted.end);
  loaded_ = {std::min(loaded_.begin, wanted.begin), std::max(loaded_.end, wanted.end)};
}

void TilePatch::load_whole(const HeightField& bed, int slot) {
  begin(slot);
  constexpr RowSpan whole{-rim, side + rim};
  load_rows(bed, whole);
  load_rim(bed, whole, true, true, [](int) -> const TilePatch* { return nullptr; });
}

void TilePatch::write_back(HeightField& bed, const CellFlags& cells) const {
  bool changed = false;
  for (int row = loaded_.begin; row < loaded_.end; ++row) {
    std::uint64_t flags = cells[row] & ~bed.walls(slot_)[row];
    if (!flags) continue;  // a shared tile stays shared
    double* out = bed.tile_heights(slot_) + row * side;
    for (; flags; flags &= flags - 1) {
      const int col = std::countr_zero(flags);
      changed |= out[col] != heights(row)[col];
      out[col] = heights(row)[col];
    }
  }
  if (changed) bed.mark_changed(slot_);
}

}  // namespace sandstroke
