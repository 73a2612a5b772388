// Relaxes only the tiles that hold sand that can move; the same bits as the reference.
#include <algorithm>

#include "core/compensated_sum.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "sand/talus_law.h"
#include "sand/tile_pass.h"

namespace sandstroke {
namespace {

/// A pass changes a tile only if something within `rim` cells of it changed in the pass before. So a tile
/// sleeps until it is disturbed from outside (its revision tells) or a neighbour's border changes.
class TileRelaxer : public Relaxer {
 public:
  TileRelaxer(const RelaxationSettings& settings, double cell_size)
      : law_(settings, cell_size), max_passes_(settings.max_passes) {}

  RelaxationOutcome relax(HeightField& bed, const std::function<void(std::int64_t)>& after_pass) override {
    wake_disturbed(bed);
    RelaxationOutcome outcome;
    CompensatedSum moved;
    while (!active_.empty()) {
      outcome.tiles_active_max = std::max(outcome.tiles_active_max, static_cast<int>(active_.size()));
      const bool stop = outcome.passes == max_passes_ || interrupted();
      if (stop) break;
      compute(bed);
      if (!apply(bed, outcome, moved)) continue;
      ++outcome.passes;
      if (after_pass) after_pass(outcome.passes);
    }
    outcome.converged = active_.empty();
    for (const int tile : active_) residuals_[tile] = TilePass::of_this_thread().residual(law_, bed, tile);
    outcome.residual = residuals_.empty() ? 0.0 : *std::max_element(residuals_.begin(), residuals_.end());
    outcome.moved_volume = moved.value() * bed.cell_area();
    for (int tile = 0; tile < bed.tile_count(); ++tile) seen_[tile] = bed.tile_revision(tile);
    return outcome;
  }

 private:
  void wake(const HeightField& bed, int tile, int row_step, int col_step) {
    const int row = tile / bed.tile_cols() + row_step, col = tile % bed.tile_cols() + col_step;
    if (row >= 0 && row < bed.tile_rows() && col >= 0 && col < bed.tile_cols())
      awake_[bed.tile_index(row, col)] = 1;
  }

  /// Takes the flagged tiles, in the bed's order, as the next pass's.
  void collect_awake() {
    active_.clear();
    for (std::size_t tile = 0; tile < awake_.size(); ++tile)
      if (awake_[tile]) active_.push_back(static_cast<int>(tile));
    std::fill(awake_.begin(), awake_.end(), char{0});
  }

  void wake_disturbed(const HeightField& bed) {
    const bool first_time = seen_.empty();
    if (first_time) {
      seen_.resize(bed.tile_count());
      awake_.resize(bed.tile_count());
      residuals_.resize(bed.tile_count());
    }
    for (const int tile : active_) awake_[tile] = 1;  // left over from a call that was cut off
    for (int tile = 0; tile < bed.tile_count(); ++tile) {
      if (!first_time && seen_[tile] == bed.tile_revision(tile)) continue;
      for (int row_step = -1; row_step <= 1; ++row_step)
        for (int col_step = -1; col_step <= 1; ++col_step) wake(bed, tile, row_step, col_step);
    }
    collect_awake();
  }

  void compute(const HeightField& bed) {
    if (next_.size() < active_.size()) next_.resize(active_.size());
    results_.resize(active_.size());
    constexpr std::size_t worth_threads = 4;  // tiles
    parallel_for(active_.size(), worth_threads, [&](std::size_t i) {
      TilePass& pass = TilePass::of_this_thread();
      results_[i] = pass.run(law_, bed, active_[i], next_[i]);
      if (!results_[i].changed) residuals_[active_[i]] = pass.residual(law_, bed, active_[i]);
    });
  }

  /// Puts the next heights in place and wakes the tiles that see a change. True if anything changed.
  bool apply(HeightField& bed, RelaxationOutcome& outcome, CompensatedSum& moved) {
    bool any = false;
    for (std::size_t i = 0; i < active_.size(); ++i) {
      const int tile = active_[i];
      const CellRange cells = bed.tile_cells(tile);
      outcome.cells_visited +=
          std::int64_t{cells.row_end - cells.row_begin} * (cells.col_end - cells.col_begin);
      const TilePass::Result& result = results_[i];
      if (!result.changed) continue;
      any = true;
      moved.add(result.moved);
      bed.swap_tile(tile, next_[i]);
      for (int row_step = -1; row_step <= 1; ++row_step) {
        if ((row_step < 0 && !result.top) || (row_step > 0 && !result.bottom)) continue;
        for (int col_step = -1; col_step <= 1; ++col_step) {
          if ((col_step < 0 && !result.left) || (col_step > 0 && !result.right)) continue;
          wake(bed, tile, row_step, col_step);
        }
      }
    }
    collect_awake();
    return any;
  }

  TalusLaw law_;
  std::int64_t max_passes_;
  std::vector<int> active_;                // tiles of the coming pass, ascending
  std::vector<char> awake_;                // per tile: belongs to the pass after it
  std::vector<TilePass::Result> results_;  // per active tile
  std::vector<std::vector<double>> next_;  // per active tile: its heights after the pass
  std::vector<std::uint64_t> seen_;        // per tile: revision when it was last left in peace
  std::vector<double> residuals_;          // per tile
};

}  // namespace

std::unique_ptr<Relaxer> make_tile_relaxer(const RelaxationSettings& settings, double cell_size) {
  return std::make_unique<TileRelaxer>(settings, cell_size);
}

}  // namespace sandstroke
