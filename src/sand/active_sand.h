#pragma once

#include <memory>
#include <vector>

#include "core/compensated_sum.h"
#include "core/parallel.h"
#include "sand/flow_kernels.h"
#include "sand/relaxation.h"
#include "sand/tile_activity.h"

namespace sandstroke {

/// What a tile that takes part in a relaxation has while that lasts.
struct RelaxedTile {
  TilePatch patch;    ///< its heights: the bed's are as they were, until they are written back
  TileFlow flow;      ///< of the last pass
  CellFlags changed;  ///< in that, in the flow's rows
};

/// The sand of a bed that can move, and one law's flow in it: what the steppers (passes, rkl) are made of. A
/// pass is compute_flow, then advance: two sweeps over the active tiles, on more threads where that pays,
/// with the same bits for any number of them.
class ActiveSand {
 public:
  // Passes with less work go on one thread: handing out tiles would cost more than it saves. In cells; a tile
  // with any active ones costs as much as 400 more (measured: tests/bench/active_sand_bench.cpp).
  static constexpr std::int64_t work_worth_threads = 8'000, work_per_tile = 400;

  /// tells_givers: super-steps will ask which cells may give.
  ActiveSand(const TalusLaw& law, double cell_size, bool tells_givers = false,
             std::int64_t worth_threads = work_worth_threads);

  /// Takes up what was set since the last relaxation.
  void begin(HeightField& bed);
  bool at_rest() const { return activity_.tiles().empty(); }
  const std::vector<int>& tiles() const { return activity_.tiles(); }  ///< active ones, by slot
  const CellFlags& cells(int slot) const { return activity_.cells(slot); }
  void rest() { activity_.rest(); }  ///< nothing is active any more
  /// Tiles are counted as they join a relaxation, so that a stepper can keep things for each.
  std::size_t place_of(int slot) const { return static_cast<std::size_t>(places_[slot]); }
  std::size_t places() const { return joined_; }
  RelaxedTile& tile_at(std::size_t place) { return *tiles_[place]; }
  RelaxedTile& tile(int slot) { return *tiles_[place_of(slot)]; }
  const RelaxedTile& tile(int slot) const { return *tiles_[place_of(slot)]; }

  /// Every active cell's gain in a pass. Returns the sum of outflows [m]. in_step(slot, tile): what a
  /// super-step has to do with a tile's flow (FlowInStep): in one only cells within one of a change may give,
  /// and all others are held still, however steep (tells_givers). join(slot) is called before for each active
  /// tile, one after the other; the first time when places() has just grown by it.
  template <class InStep, class Join>
  double compute_flow(HeightField& bed, const InStep& in_step, const Join& join);
  /// What the pass has to look at, in cells.
  std::int64_t work() const { return work_; }
  /// body(slot, tile) for each active tile.
  template <class Body>
  void for_each_tile(const Body& body) {
    for_active_tiles([&](int slot) { body(slot, tile(slot)); });
  }

  /// Calls apply(slot, tile) for each active tile: it changes the tile's patch, and flags in `changed` the
  /// cells that are another number now. Next active: the cells that see a change. False where nothing
  /// changed, and nothing is active.
  template <class Apply>
  bool advance(HeightField& bed, const Apply& apply) {
    for_each_tile(apply);
    activity_.advance(bed, [this](int slot) {
      return TileActivity::Changed{tile(slot).changed, tile(slot).flow.rows};
    });
    return !at_rest();
  }

  /// Brings to the bed what the passes so far have made of it.
  void write_back(HeightField& bed) const;

  /// Heap memory for each tile that takes part in a relaxation [bytes].
  static constexpr std::size_t bytes_per_tile() {
    return sizeof(RelaxedTile) + sizeof(PatchHeights) + sizeof(int) + sizeof(Residuals) + sizeof(double) +
           TileActivity::bytes_per_tile();
  }

  /// Ends a relaxation: writes back; residual of the whole bed, and the counters since begin(). The flow of
  /// what is still active must have been computed: only what takes part is looked at.
  void end(HeightField& bed, RelaxationOutcome& outcome);

 private:
  template <class Body>
  void for_active_tiles(const Body& body) const {
    parallel_for(tiles().size(), work_ >= worth_threads_, [&](std::size_t i) { body(tiles()[i]); });
  }
  void take_part(int slot);
  void look_at_active_cells();
  void load_rim(const HeightField& bed, TilePatch& patch, RowSpan rows, const CellFlags& cells) const;
  void load_givers(const HeightField& bed, int slot, RowSpan rows, FlowScratch& scratch) const;

  TalusLaw law_;
  std::int64_t worth_threads_;
  double stable_slope_;  // rise over run
  TileActivity activity_;

  // Of this relaxation: by place; those beyond joined_ are left from others.
  std::vector<std::unique_ptr<RelaxedTile>> tiles_;
  std::size_t joined_ = 0;
  std::vector<int> places_;  // per slot; -1: takes no part
  // Residual of each group of cells, per slot, and their largest; after the last relaxation that saw them.
  using Residuals = std::array<double, HeightField::tile_area / cells_per_group>;
  std::vector<Residuals> group_residuals_;
  std::vector<double> residuals_;

  std::int64_t work_ = 0, cells_visited_ = 0, wake_ups_before_ = 0;
  int tiles_active_max_ = 0;
};

template <class InStep, class Join>
double ActiveSand::compute_flow(HeightField& bed, const InStep& in_step, const Join& join) {
  for (const int slot : tiles()) {
    take_part(slot);
    join(slot);
  }
  look_at_active_cells();
  // What the next heights of cells depend on is two cells away.
  const auto seen_rows = [&](int slot) {
    const RowSpan rows = activity_.rows(slot);
    return RowSpan{rows.begin - TilePatch::rim, rows.end + TilePatch::rim};
  };
  for_active_tiles([&](int slot) { tile(slot).patch.load_rows(bed, seen_rows(slot)); });
  for_active_tiles([&](int slot) {
    RelaxedTile& one = tile(slot);
    load_rim(bed, one.patch, seen_rows(slot), cells(slot));
    FlowScratch& scratch = FlowScratch::of_this_thread();
    const FlowInStep step = in_step(slot, one);
    if (step.first) load_givers(bed, slot, activity_.rows(slot), scratch);
    sandstroke::compute_flow(law_, one.patch, cells(slot), activity_.rows(slot), step, scratch, one.flow);
  });
  CompensatedSum given;
  for (const int slot : tiles()) given.add(tile(slot).flow.given);
  return given.value();
}

// The relaxers of each method.
std::unique_ptr<Relaxer> make_plain_relaxer(const RelaxationSettings& settings, double cell_size);
std::unique_ptr<Relaxer> make_tile_relaxer(const RelaxationSettings& settings, double cell_size);
std::unique_ptr<Relaxer> make_rkl_relaxer(const RelaxationSettings& settings, double cell_size);
/// Heap memory [bytes] of the rkl relaxer besides ActiveSand, for each tile that takes part.
std::size_t rkl_bytes_per_tile();

}  // namespace sandstroke
