#include "sand/active_sand.h"

#include <algorithm>

#include "core/compensated_sum.h"

namespace sandstroke {

ActiveSand::ActiveSand(const TalusLaw& law, double cell_size, bool holds_still, std::int64_t worth_threads)
    : law_(law),
      holds_still_(holds_still),
      worth_threads_(worth_threads),
      stable_slope_(stable_slope(law, cell_size)),
      activity_(holds_still) {}

void ActiveSand::begin(HeightField& bed) {
  cells_visited_ = 0;
  tiles_active_max_ = 0;
  wake_ups_before_ = activity_.wake_ups();
  activity_.wake_disturbed(bed, stable_slope_);
}

std::int64_t ActiveSand::look_at_active_cells() {
  tiles_active_max_ = std::max(tiles_active_max_, static_cast<int>(tiles().size()));
  std::int64_t cells_looked_at = 0;
  for (const int slot : tiles()) {
    if (looks_.size() <= static_cast<std::size_t>(slot)) looks_.resize(slot + 1), residuals_.resize(slot + 1);
    Look& look = looks_[slot];
    if (!look.listed) {
      look.listed = true;
      looked_at_.push_back(slot);
    }
    const CellFlags& active = cells(slot);
    for (int row = 0; row < HeightField::tile_side; ++row) look.cells[row] |= active[row];
    cells_looked_at += count(active);
  }
  return cells_looked_at;
}

double ActiveSand::compute_flow(const HeightField& bed,
                                const std::function<void(int, const TileFlow&)>& then) {
  const std::int64_t cells_looked_at = look_at_active_cells();
  cells_visited_ += cells_looked_at;
  work_ = cells_looked_at + work_per_tile * static_cast<std::int64_t>(tiles().size());
  while (flows_.size() < tiles().size()) flows_.push_back(std::make_unique<TileFlow>());
  if (changed_.size() < tiles().size()) changed_.resize(tiles().size()), any_changed_.resize(tiles().size());
  for_active_tiles([&](std::size_t i) {
    const int slot = tiles()[i];
    TilePatch& patch = TilePatch::of_this_thread();
    patch.load(bed, slot, cells(slot));
    if (holds_still_) {
      GiverFlags givers{};
      load_givers(bed, slot, givers);
      sandstroke::compute_flow(law_, patch, cells(slot), &givers, *flows_[i]);
    } else {
      sandstroke::compute_flow(law_, patch, cells(slot), nullptr, *flows_[i]);
    }
    if (then) then(slot, *flows_[i]);
  });
  CompensatedSum given;
  for (std::size_t i = 0; i < tiles().size(); ++i) given.add(flows_[i]->given);
  return given.value();
}

void ActiveSand::load_givers(const HeightField& bed, int slot, GiverFlags& givers) const {
  constexpr int side = HeightField::tile_side;
  // Row `from` of the tile at (row_step, col_step), as `count` rows of the flags from row `to` on.
  const auto load = [&](int row_step, int col_step, int from, int to, int count, const auto& put) {
    const int beside = bed.tile_beside(bed.tile_of(slot), row_step, col_step);
    const int other = beside < 0 ? -1 : bed.slot_of(beside);
    if (other < 0) return;
    const CellFlags& flags = activity_.givers(other);
    for (int r = 0; r < count; ++r) put(givers.rows[to + r], flags[from + r]);
  };
  for (int col_step = -1; col_step <= 1; ++col_step) {
    const auto put = [col_step](GiverFlags::Row& row, std::uint64_t flags) {
      if (col_step < 0) row.west = flags >> (side - 1) != 0;
      if (col_step == 0) row.own = flags;
      if (col_step > 0) row.east = (flags & 1) != 0;
    };
    load(-1, col_step, side - 1, 0, 1, put);
    load(0, col_step, 0, 1, side, put);
    load(1, col_step, 0, side + 1, 1, put);
  }
}

void ActiveSand::end(const HeightField& bed, RelaxationOutcome& outcome) {
  const std::int64_t work = work_per_tile * static_cast<std::int64_t>(looked_at_.size());
  parallel_for(looked_at_.size(), work >= worth_threads_, [&](std::size_t i) {
    const int slot = looked_at_[i];
    Look& look = looks_[slot];
    TilePatch& patch = TilePatch::of_this_thread();
    patch.load(bed, slot, look.cells);
    compute_residuals(law_, patch, look.cells, look.steepest.data());
    residuals_[slot] = std::max(0.0, *std::max_element(look.steepest.begin(), look.steepest.end()));
  });
  for (const int slot : looked_at_) {
    looks_[slot].cells = {};
    looks_[slot].listed = false;
  }
  looked_at_.clear();

  outcome.residual = 0.0;
  for (const double residual : residuals_) outcome.residual = std::max(outcome.residual, residual);
  outcome.converged = at_rest();
  outcome.cells_visited = cells_visited_;
  outcome.tiles_active_max = tiles_active_max_;
  outcome.wake_ups = activity_.wake_ups() - wake_ups_before_;
}

}  // namespace sandstroke
