#include "sand/active_sand.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sand/slope_kernels.h"
#include "sand/steep_tiles.h"
#include "sand/super_step_kernels.h"

namespace sandstroke {
namespace {

/// Lays out in `patch` the ground under a tile (by index); null where it makes no difference.
void load_ground(const HeightField& bed, int tile, bool near_level, std::unique_ptr<GroundPatch>& patch) {
  const Ground* ground = bed.ground();
  if (!ground || !(near_level || ground->has_floor_around(tile) || ground->has_slopes_around(tile)))
    return patch.reset();
  if (!patch) patch = std::make_unique<GroundPatch>();
  patch->load(bed.shared_ground(), tile, near_level);
}

}  // namespace

ActiveSand::ActiveSand(const TalusLaw& law, double tolerance, double cell_size, Givers givers,
                       const SandStart& start, std::int64_t worth_threads)
    : law_(law),
      tolerance_(tolerance),
      worth_threads_(worth_threads),
      stable_slope_(stable_slope(law, cell_size)),
      talus_factors_(start.talus_factors),
      looks_at_all_(start.wake == FirstWake::too_steep),
      activity_(givers) {}

void ActiveSand::begin(HeightField& bed) {
  if (joined_ > 0) {  // an exception ended the last relaxation
    std::fill(numbers_.begin(), numbers_.end(), -1);
    joined_ = 0;
  }
  tiles_.begin();
  cells_visited_ = 0;
  tiles_active_max_ = 0;
  wake_ups_before_ = activity_.wake_ups();
  look_at_floor(bed);
  if (std::exchange(looks_at_all_, false)) wake_too_steep(bed);
  activity_.wake_disturbed(bed);
}

void ActiveSand::know_slots(int count) {
  if (numbers_.size() >= static_cast<std::size_t>(count)) return;
  numbers_.resize(count, -1);
  while (group_residuals_.size() < numbers_.size()) group_residuals_.emplace_back();
  residuals_.resize(group_residuals_.size());
}

void ActiveSand::look_at_floor(const HeightField& bed) {
  // What lies above the floor's level all around cannot get below it, since relaxing sand gets no lower than
  // the lowest cell. So the level matters only once something is as low.
  if (near_level_ || !bed.ground()) return;
  const double level = bed.ground()->level();
  if (level == -std::numeric_limits<double>::infinity()) return;
  const double near = level + 2.0 * law_.thinnest;
  const auto is_near = [&](const double* heights, const CellRange& cells) {
    return range_of(heights, cells.rows(), cells.cols()).low <= near;
  };
  if (looks_at_all_) {
    std::vector<double> heights(HeightField::tile_area);
    for (int tile = 0; tile < bed.tile_count() && !near_level_; ++tile) {
      bed.read_tile(tile, heights.data());
      near_level_ = is_near(heights.data(), bed.tile_cells(tile));
    }
    return;
  }
  for (const int slot : bed.disturbed_tiles())
    near_level_ = near_level_ || is_near(bed.tile_heights(slot), bed.tile_cells(bed.tile_of(slot)));
}

void ActiveSand::measure_residuals(const TilePatch& patch, const GroundPatch* ground,
                                   const CellFlags& cells) {
  Residuals& groups = group_residuals_[patch.slot()].write();
  compute_residuals(law_, patch, ground, cells, groups.data());
  residuals_[patch.slot()] = std::max(0.0, *std::max_element(groups.begin(), groups.end()));
}

void ActiveSand::wake_too_steep(HeightField& bed) {
  const double part =
      bed.ground() ? std::min(1.0, bed.ground()->flattest() / law_.axis_drop * bed.cell_size()) : 1.0;
  visit_steep_tiles(bed, stable_slope_ * part, [&](int tile) { bed.allocate(tile); });
  const int existing = bed.allocated_tiles();
  for (int slot = 0; slot < existing; ++slot) bed.allocate_around(bed.tile_of(slot));
  const int tiles = bed.allocated_tiles();
  know_slots(tiles);
  parallel_for(tiles, work_per_tile * tiles >= worth_threads_, [&](std::size_t at) {
    const int slot = static_cast<int>(at);
    thread_local TilePatch patch;
    patch.load_whole(bed, slot);
    const CellRange inside = bed.tile_cells(bed.tile_of(slot));
    CellFlags cells{};
    std::fill_n(cells.begin(), inside.rows(), columns_between(0, inside.cols()));
    thread_local std::unique_ptr<GroundPatch> ground;
    load_ground(bed, bed.tile_of(slot), near_level_, ground);
    measure_residuals(patch, ground.get(), cells);
  });
  // A little less, since laws do not compare slopes as fractions.
  const double limit = tolerance_ - 1e-12;
  constexpr int groups = HeightField::tile_side / cells_per_group;
  for (int slot = 0; slot < tiles; ++slot) {
    if (!(residuals_[slot] > limit)) continue;
    CellFlags steep{};
    for (int row = 0; row < HeightField::tile_side; ++row)
      for (int group = 0; group < groups; ++group)
        if ((*group_residuals_[slot])[row * groups + group] > limit)
          steep[row] |= columns_between(group * cells_per_group, (group + 1) * cells_per_group);
    activity_.wake_around(bed, slot, {steep, all_rows});
  }
}

void ActiveSand::take_part(const HeightField& bed, int slot) {
  know_slots(slot + 1);
  if (numbers_[slot] >= 0) return;
  numbers_[slot] = static_cast<int>(joined_++);
  if (tiles_.size() < joined_) tiles_.add();
  tile(slot).patch.begin(slot);
  load_ground(bed, bed.tile_of(slot), near_level_, tile(slot).ground);
  if (talus_factors_)
    load_slope_weights(bed.tile_of(slot), tile(slot).slope_weights);
  else
    tile(slot).slope_weights.reset();
}

void ActiveSand::load_slope_weights(int tile, std::unique_ptr<TilePatch>& weights) {
  talus_factors_->allocate_around(tile);
  if (!weights) weights = std::make_unique<TilePatch>();
  weights->load_whole(*talus_factors_, talus_factors_->slot_of(tile));
  for (int row = -TilePatch::rim; row < TilePatch::side + TilePatch::rim; ++row)
    for (int col = -TilePatch::rim; col < TilePatch::side + TilePatch::rim; ++col) {
      double& one = weights->heights(row)[col];
      one = 1.0 / (one * one);
    }
}

void ActiveSand::look_at_active_cells() {
  tiles_active_max_ = std::max(tiles_active_max_, static_cast<int>(tiles().size()));
  active_cells_ = 0;
  for (const int slot : tiles()) active_cells_ += count(cells(slot), activity_.rows(slot));
  cells_visited_ += active_cells_;
  work_ = active_cells_ + work_per_tile * static_cast<std::int64_t>(tiles().size());
}

void ActiveSand::load_rim(const HeightField& bed, TilePatch& patch, RowSpan rows,
                          const CellFlags& cells) const {
  // Kernels compute whole groups, those of the cells' neighbours included.
  const std::uint64_t seen =
      columns_of(cells, {std::max(rows.begin, 0), std::min(rows.end, TilePatch::side)});
  constexpr int near = cells_per_group + 1;
  patch.load_rim(bed, rows, (seen & columns_between(0, near)) != 0,
                 (seen & columns_between(TilePatch::side - near, TilePatch::side)) != 0,
                 [this](int slot) { return takes_part(slot) ? &tile(slot).patch : nullptr; });
}

void ActiveSand::load_givers(const HeightField& bed, int slot, RowSpan rows, FlowScratch& scratch) const {
  constexpr int side = HeightField::tile_side;
  const int tile = bed.tile_of(slot);
  for (int part = -1; part <= 1; ++part) {  // the tile row above, the tile's own, the one below
    const int begin = std::max(rows.begin - 1, part < 0 ? -1 : part * side);
    const int end = std::min(rows.end + 1, part > 0 ? side + 1 : (part + 1) * side);
    if (begin >= end) continue;
    const auto flags_of = [&](int col_part) -> const std::uint64_t* {
      const int beside = bed.tile_beside(tile, part, col_part);
      const int other = beside < 0 ? -1 : bed.slot_of(beside);
      static constexpr CellFlags none{};
      return other < 0 ? none.data() : activity_.givers(other).data();
    };
    const std::uint64_t *own = flags_of(0), *west = flags_of(-1), *east = flags_of(1);
    for (int row = begin; row < end; ++row) {
      const int there = row - part * side;
      scratch.givers[row + 1] = {own[there], west[there] >> (side - 1) != 0, (east[there] & 1) != 0};
    }
  }
}

void ActiveSand::write_back(HeightField& bed) const {
  parallel_for(joined_, work_ >= worth_threads_, [&](std::size_t i) {
    tiles_[i].patch.write_back(bed, activity_.seen(tiles_[i].patch.slot()));
  });
}

void ActiveSand::end(HeightField& bed, RelaxationOutcome& outcome) {
  write_back(bed);
  work_ = work_per_tile * static_cast<std::int64_t>(joined_);
  parallel_for(joined_, work_ >= worth_threads_, [&](std::size_t i) {
    TilePatch& patch = tiles_[i].patch;
    const CellFlags& seen = activity_.seen(patch.slot());
    const RowSpan rows = row_span(seen);
    const RowSpan around{rows.begin - TilePatch::rim, rows.end + TilePatch::rim};
    patch.load_rows(bed, around);
    patch.load_rim(bed, around, true, true, [](int) { return nullptr; });
    measure_residuals(patch, tiles_[i].ground.get(), seen);
  });
  for (std::size_t i = 0; i < joined_; ++i) {
    numbers_[tiles_[i].patch.slot()] = -1;
    activity_.look_away(tiles_[i].patch.slot());
  }
  joined_ = 0;
  tiles_.end();

  outcome.residual = 0.0;
  for (const double residual : residuals_) outcome.residual = std::max(outcome.residual, residual);
  outcome.converged = at_rest();
  outcome.cells_visited = cells_visited_;
  outcome.tiles_active_max = tiles_active_max_;
  outcome.wake_ups = activity_.wake_ups() - wake_ups_before_;
}

void ActiveSand::visit_state(StateVisitor& state) {
  state.value("relaxation.looks_at_all", looks_at_all_);
  state.value("relaxation.near_level", near_level_);
  state.list("relaxation.residuals", residuals_);
  if (state.restores()) {
    numbers_.clear();
    group_residuals_.clear();
    know_slots(static_cast<int>(residuals_.size()));
  }
  for (SharedUntilWritten<Residuals>& residuals : group_residuals_) {
    Residuals groups = *residuals;
    state.value("relaxation.group_residuals", groups);
    if (state.restores()) residuals.write() = groups;
  }
  activity_.visit_state(state);
}

}  // namespace sandstroke
