#include "sand/active_sand.h"

#include <algorithm>

#include "core/compensated_sum.h"

namespace sandstroke {

ActiveSand::ActiveSand(const TalusLaw& law, double cell_size)
    : law_(law), stable_slope_(stable_slope(law, cell_size)) {}

void ActiveSand::begin(HeightField& bed) {
  cells_visited_ = 0;
  tiles_active_max_ = 0;
  wake_ups_before_ = activity_.wake_ups();
  activity_.wake_disturbed(bed, stable_slope_);
}

void ActiveSand::look_at_active_cells() {
  active_cells_ = 0;
  for (const int slot : tiles()) {
    if (looks_.size() <= static_cast<std::size_t>(slot)) looks_.resize(slot + 1);
    Look& look = looks_[slot];
    if (!look.listed) {
      look.listed = true;
      looked_at_.push_back(slot);
    }
    const CellFlags& active = activity_.cells(slot);
    for (int row = 0; row < HeightField::tile_side; ++row) look.cells[row] |= active[row];
    active_cells_ += count(active);
  }
  cells_visited_ += active_cells_;
  tiles_active_max_ = std::max(tiles_active_max_, static_cast<int>(tiles().size()));
}

double ActiveSand::compute_flow(const HeightField& bed, const TileHeights& heights) {
  look_at_active_cells();
  while (flows_.size() < tiles().size()) flows_.push_back(std::make_unique<TileFlow>());
  if (changed_.size() < tiles().size()) changed_.resize(tiles().size()), any_changed_.resize(tiles().size());
  for_active_tiles([&](std::size_t i) {
    const int slot = tiles()[i];
    TilePatch& patch = TilePatch::of_this_thread();
    patch.load(bed, slot, cells(slot), heights);
    sandstroke::compute_flow(law_, patch, cells(slot), *flows_[i]);
  });
  CompensatedSum given;
  for (std::size_t i = 0; i < tiles().size(); ++i) given.add(flows_[i]->given);
  return given.value();
}

void ActiveSand::end(const HeightField& bed, RelaxationOutcome& outcome) {
  look_at_active_cells();
  cells_visited_ -= active_cells_;  // looked at for their residual only
  const auto heights = [&bed](int slot) { return bed.tile_heights(slot); };
  parallel_for(looked_at_.size(), cells_visited_ >= cells_worth_threads, [&](std::size_t i) {
    const int slot = looked_at_[i];
    Look& look = looks_[slot];
    TilePatch& patch = TilePatch::of_this_thread();
    patch.load(bed, slot, look.cells, heights);
    compute_residuals(law_, patch, look.cells, look.steepest.data());
    look.residual = std::max(0.0, *std::max_element(look.steepest.begin(), look.steepest.end()));
  });
  for (const int slot : looked_at_) {
    looks_[slot].cells = {};
    looks_[slot].listed = false;
  }
  looked_at_.clear();

  outcome.residual = 0.0;
  for (const Look& look : looks_) outcome.residual = std::max(outcome.residual, look.residual);
  outcome.converged = at_rest();
  outcome.cells_visited = cells_visited_;
  outcome.tiles_active_max = tiles_active_max_;
  outcome.wake_ups = activity_.wake_ups() - wake_ups_before_;
}

}  // namespace sandstroke
