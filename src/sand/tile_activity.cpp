#include "sand/tile_activity.h"

#include <algorithm>

namespace sandstroke {
namespace {

constexpr int side = BedGeometry::tile_side;
constexpr int reach = 2;  // cells

}  // namespace

void TileActivity::wake_disturbed(HeightField& bed) {
  for (const int slot : bed.disturbed_tiles()) wake_around(bed, slot, {bed.disturbed_cells(slot), all_rows});
  bed.clear_disturbed();
  make_seen_tiles(bed);
}

void TileActivity::rest() {
  for (const int slot : tiles_) marks_[slot]->sleep();
  tiles_.clear();
}

void TileActivity::wake(HeightField& bed, int tile, int row_begin, const std::uint64_t* active,
                        const std::uint64_t* givers, int count) {
  const CellRange cells = bed.tile_cells(tile);
  const std::uint64_t inside = columns_between(0, cells.cols());
  count = std::min(count, cells.rows() - row_begin);
  std::uint64_t some = 0;
  for (int r = 0; r < count; ++r) some |= active[r] & inside;
  if (!some) return;
  const int slot = bed.allocate(tile);
  Marks& marks = marks_.make(slot);
  const std::uint64_t* walls = bed.walls(slot).data() + row_begin;
  RowSpan rows{row_begin + count, row_begin};
  for (int r = 0; r < count; ++r) {
    marks.seen[row_begin + r] |= active[r] & inside;
    const std::uint64_t free = inside & ~walls[r];
    if (!(active[r] & free)) continue;
    marks.active[row_begin + r] |= active[r] & free;
    if (tells_givers_) marks.givers[row_begin + r] |= givers[r] & free;
    rows = {std::min(rows.begin, row_begin + r), row_begin + r + 1};
  }
  marks.rows = joined(marks.rows, rows);
  if (marks.listed) return;
  marks.listed = true;
  wake_ups_ += !marks.was_active;
  tiles_.push_back(slot);
}

namespace {

/// Flags of the cells within `by` of a tile's flagged ones, in the tile and its neighbours, in rows [begin,
/// end). Row r is row r - reach of the tile.
struct Spread {
  std::array<std::uint64_t, side + 2 * reach> own, west, east;
  std::uint64_t any_west = 0, any_east = 0;

  /// flags: the first is of row -2 reach of the tile.
  template <int by>
  void fill(const std::uint64_t* flags, int begin, int end) {
    for (int r = begin; r < end; ++r) {
      std::uint64_t f = 0;
      for (int i = -by; i <= by; ++i) f |= flags[r + reach + i];
      own[r] = f | f << 1 | f >> 1;
      west[r] = f << (side - 1);
      east[r] = f >> (side - 1);
      if constexpr (by == 2) {
        own[r] |= f << 2 | f >> 2;
        west[r] |= f << (side - 2);
        east[r] |= f >> (side - 2);
      }
      any_west |= west[r];
      any_east |= east[r];
    }
  }
};

}  // namespace

void TileActivity::wake_around(HeightField& bed, int slot, const Changed& changed) {
  const RowSpan span = row_span(changed.cells, changed.rows);
  if (span.empty()) return;
  const int begin = span.begin, end = span.end + 2 * reach;
  std::array<std::uint64_t, side + 4 * reach> flags;  // with empty rows around the span
  std::fill(flags.begin() + begin, flags.begin() + begin + 2 * reach, 0);
  std::copy(changed.cells.begin() + span.begin, changed.cells.begin() + span.end,
            flags.begin() + begin + 2 * reach);
  std::fill(flags.begin() + end, flags.begin() + end + 2 * reach, 0);
  Spread active, givers;
  active.fill<reach>(flags.data(), begin, end);
  if (tells_givers_) givers.fill<1>(flags.data(), begin, end);

  const auto wake_column = [&](int col_step, const auto& rows, const auto& giving) {
    const auto wake_rows = [&](int row_step, int to, int first, int last) {
      const int tile = bed.tile_beside(bed.tile_of(slot), row_step, col_step);
      if (tile >= 0) wake(bed, tile, to, rows.data() + first, giving.data() + first, last - first);
    };
    const int first = std::max(begin, reach), last = std::min(end, side + reach);
    wake_rows(0, first - reach, first, last);
    if (begin < reach) wake_rows(-1, side - reach + begin, begin, reach);
    if (end > side + reach) wake_rows(1, 0, side + reach, end);
  };
  wake_column(0, active.own, givers.own);
  if (active.any_west) wake_column(-1, active.west, givers.west);
  if (active.any_east) wake_column(1, active.east, givers.east);
}

void TileActivity::make_seen_tiles(HeightField& bed) {
  for (const int slot : tiles_) {
    const CellFlags& active = marks_[slot]->active;
    const std::uint64_t all = columns_of(active, marks_[slot]->rows);
    const bool sees_north = (active[0] | active[1]) != 0,
               sees_south = (active[side - 2] | active[side - 1]) != 0;
    const bool sees_west = (all & columns_between(0, reach)) != 0,
               sees_east = (all & columns_between(side - reach, side)) != 0;
    for (int row_step = -sees_north; row_step <= sees_south; ++row_step)
      for (int col_step = -sees_west; col_step <= sees_east; ++col_step)
        if (const int tile = bed.tile_beside(bed.tile_of(slot), row_step, col_step); tile >= 0)
          bed.allocate(tile);
  }
}

void TileActivity::visit_state(StateVisitor& state) {
  state.list("relaxation.awake", tiles_);
  if (state.restores()) marks_ = {};
  for (const int slot : tiles_)
    state.value("relaxation.awake.cells", marks_.make(static_cast<std::size_t>(slot)));
  state.value("relaxation.wake_ups", wake_ups_);
}

}  // namespace sandstroke
