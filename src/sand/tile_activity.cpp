#include "sand/tile_activity.h"

#include <algorithm>

#include "sand/steep_tiles.h"

namespace sandstroke {
namespace {

constexpr int side = BedGeometry::tile_side;
constexpr int reach = 2;  // cells

/// The columns [begin, end) as flags.
std::uint64_t columns(int begin, int end) {
  const std::uint64_t below_end = end == side ? ~std::uint64_t{0} : (std::uint64_t{1} << end) - 1;
  return below_end & (~std::uint64_t{0} << begin);
}

}  // namespace

std::int64_t TileActivity::cell_count() const {
  std::int64_t cells = 0;
  for (const int slot : tiles_) cells += count(active_[slot]);
  return cells;
}

void TileActivity::wake_disturbed(HeightField& bed, double stable_slope) {
  if (first_time_) {
    first_time_ = false;
    CellFlags all;
    all.fill(~std::uint64_t{0});
    for (int slot = 0, end = bed.touched_tiles(); slot < end; ++slot)
      wake(bed, bed.tile_of(slot), 0, all.data(), side);
    visit_steep_tiles(bed, stable_slope, [&](int tile) { wake(bed, tile, 0, all.data(), side); });
  } else {
    for (const int slot : bed.disturbed_tiles()) wake_around(bed, slot, bed.disturbed_cells(slot));
  }
  bed.settle();
  make_seen_tiles(bed);
}

void TileActivity::advance(HeightField& bed, const std::vector<CellFlags>& changed,
                           const std::vector<char>& any_changed) {
  for (const int slot : tiles_) {
    active_[slot] = {};
    listed_[slot] = 0;
    was_active_[slot] = 1;
  }
  tiles_before_.swap(tiles_);
  tiles_.clear();
  for (std::size_t i = 0; i < tiles_before_.size(); ++i)
    if (any_changed[i]) wake_around(bed, tiles_before_[i], changed[i]);
  for (const int slot : tiles_before_) was_active_[slot] = 0;
  make_seen_tiles(bed);
}

void TileActivity::add(HeightField& bed, int slot, const CellFlags& cells) {
  wake(bed, bed.tile_of(slot), 0, cells.data(), side);
}

void TileActivity::wake(HeightField& bed, int tile, int row_begin, const std::uint64_t* rows, int count) {
  const CellRange cells = bed.tile_cells(tile);
  const std::uint64_t inside = columns(0, cells.cols());
  count = std::min(count, cells.rows() - row_begin);
  std::uint64_t some = 0;
  for (int r = 0; r < count; ++r) some |= rows[r] & inside;
  if (!some) return;
  const int slot = bed.touch(tile);
  if (active_.size() <= static_cast<std::size_t>(slot)) {
    active_.resize(slot + 1);
    listed_.resize(slot + 1);
    was_active_.resize(slot + 1);
  }
  for (int r = 0; r < count; ++r) active_[slot][row_begin + r] |= rows[r] & inside;
  if (listed_[slot]) return;
  listed_[slot] = 1;
  wake_ups_ += !was_active_[slot];
  tiles_.push_back(slot);
}

void TileActivity::wake_around(HeightField& bed, int slot, const CellFlags& changed) {
  // Row r of these is row r - reach of the tile: what is flagged there, in the tile and in those beside it.
  std::array<std::uint64_t, side + 2 * reach> own{}, west{}, east{};
  const RowSpan span = row_span(changed);
  if (span.begin == span.end) return;
  std::uint64_t any_west = 0, any_east = 0;
  for (int row = span.begin; row < span.end; ++row) {
    const std::uint64_t c = changed[row];
    const std::uint64_t o = c | c << 1 | c << 2 | c >> 1 | c >> 2;
    const std::uint64_t w = c << 63 | c << 62, e = c >> 63 | c >> 62;
    any_west |= w, any_east |= e;
    for (int r = row; r <= row + 2 * reach; ++r) own[r] |= o, west[r] |= w, east[r] |= e;
  }
  const int tile_row = bed.tile_of(slot) / bed.tile_cols(), tile_col = bed.tile_of(slot) % bed.tile_cols();
  const auto wake_column = [&](int col, const auto& rows) {
    if (col < 0 || col >= bed.tile_cols()) return;
    wake(bed, bed.tile_index(tile_row, col), 0, rows.data() + reach, side);
    if (span.begin < reach && tile_row > 0)
      wake(bed, bed.tile_index(tile_row - 1, col), side - reach, rows.data(), reach);
    if (span.end > side - reach && tile_row + 1 < bed.tile_rows())
      wake(bed, bed.tile_index(tile_row + 1, col), 0, rows.data() + reach + side, reach);
  };
  wake_column(tile_col, own);
  if (any_west) wake_column(tile_col - 1, west);
  if (any_east) wake_column(tile_col + 1, east);
}

void TileActivity::make_seen_tiles(HeightField& bed) {
  for (const int slot : tiles_) {
    const CellFlags& active = active_[slot];
    std::uint64_t all = 0;
    for (const std::uint64_t row : active) all |= row;
    const bool sees_north = (active[0] | active[1]) != 0,
               sees_south = (active[side - 2] | active[side - 1]) != 0;
    const bool sees_west = (all & columns(0, reach)) != 0,
               sees_east = (all & columns(side - reach, side)) != 0;
    const int tile = bed.tile_of(slot), tile_row = tile / bed.tile_cols(), tile_col = tile % bed.tile_cols();
    for (int row = tile_row - sees_north; row <= tile_row + sees_south; ++row)
      for (int col = tile_col - sees_west; col <= tile_col + sees_east; ++col)
        if (row >= 0 && row < bed.tile_rows() && col >= 0 && col < bed.tile_cols())
          bed.touch(bed.tile_index(row, col));
  }
}

}  // namespace sandstroke
