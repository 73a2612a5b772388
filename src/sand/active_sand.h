#pragma once

#include <memory>
#include <vector>

#include "core/borrowed_scratch.h"
#include "core/compensated_sum.h"
#include "core/copied.h"
#include "core/parallel.h"
#include "core/shared_until_written.h"
#include "sand/flow_kernels.h"
#include "sand/relaxation.h"
#include "sand/tile_activity.h"

namespace sandstroke {

/// The working data of a tile while it takes part in a relaxation.
struct RelaxedTile {
  TilePatch patch;                           ///< its heights; the bed keeps the old ones until write_back()
  TileFlow flow;                             ///< flow of the last pass
  CellFlags changed;                         ///< cells that the last pass changed, in the flow's rows
  std::unique_ptr<TilePatch> slope_weights;  ///< 1 / talus factor^2, if the sand has such factors
  std::unique_ptr<GroundPatch> ground;       ///< null: the sand is deep and of one kind
};

/// The sand that the first relaxation of a bed wakes: what is too steep and what was disturbed; or only the
/// latter, where all other sand is known to rest.
enum class FirstWake { too_steep, disturbed };

/// How a bed is taken over.
struct SandStart {
  FirstWake wake = FirstWake::too_steep;
  /// The talus slope of each cell over the law's (isotropic only), or null. Its tiles are allocated as they
  /// are needed.
  HeightField* talus_factors = nullptr;
};

/// The sand of a bed that can move, and its flow by one law. The steppers (passes, rkl) are built on it. A
/// pass calls compute_flow, then advance. Each sweeps the active tiles once, on several threads where that
/// pays; the bits are the same for any number of threads.
class ActiveSand {
 public:
  // Passes with less work [cells] run on one thread, since handing out tiles would cost more than it saves. A
  // tile with any active cell costs as much as 400 more cells (measured: tests/bench/active_sand_bench.cpp).
  static constexpr std::int64_t work_worth_threads = 8'000, work_per_tile = 400;

  /// tolerance: sand rests whose slope exceeds tan(talus) by at most this fraction. givers: near_changes for
  /// super-steps.
  ActiveSand(const TalusLaw& law, double tolerance, double cell_size, Givers givers = Givers::all,
             const SandStart& start = {}, std::int64_t worth_threads = work_worth_threads);

  /// Begins a relaxation: activates the sand around the cells that were set since the last one. The first one
  /// looks at all allocated tiles and those whose rule is steep, and activates the sand that is too steep,
  /// too.
  void begin(HeightField& bed);
  bool at_rest() const { return activity_.tiles().empty(); }
  const std::vector<int>& tiles() const { return activity_.tiles(); }  ///< slots of the active tiles
  const CellFlags& cells(int slot) const { return activity_.cells(slot); }
  std::int64_t active_cells() const { return active_cells_; }  ///< in the last compute_flow()
  void rest() { activity_.rest(); }                            ///< nothing is active any more
  bool takes_part(int slot) const {
    return static_cast<std::size_t>(slot) < numbers_.size() && numbers_[slot] >= 0;
  }
  /// Each tile gets a number when it joins a relaxation, so that a stepper can keep data for it.
  std::size_t number_of(int slot) const { return static_cast<std::size_t>(numbers_[slot]); }
  std::size_t joined() const { return joined_; }  ///< how many have
  RelaxedTile& tile_at(std::size_t number) { return tiles_[number]; }
  RelaxedTile& tile(int slot) { return tiles_[number_of(slot)]; }
  const RelaxedTile& tile(int slot) const { return tiles_[number_of(slot)]; }

  /// Computes every active cell's gain in a pass. Returns the sum of outflows [m]. in_step(slot, tile)
  /// returns what a super-step does with a tile's flow (FlowInStep). In a super-step only cells within one of
  /// a change may give; no other cell gives, however steep (Givers::near_changes). join(slot) is called
  /// first, for one active tile after the other; at a tile's first call joined() has just grown by it.
  template <class InStep, class Join>
  double compute_flow(HeightField& bed, const InStep& in_step, const Join& join);
  /// The cost of the pass, in cells: its active cells, and work_per_tile for each active tile.
  std::int64_t work() const { return work_; }
  /// Calls body(slot, tile) for each active tile.
  template <class Body>
  void for_each_tile(const Body& body) {
    for_active_tiles([&](int slot) { body(slot, tile(slot)); });
  }

  /// Calls apply(slot, tile) for each active tile. apply changes the tile's patch, and flags in `changed` the
  /// cells whose height changed. The cells that see a change are active next. Returns false if nothing
  /// changed; then nothing is active.
  template <class Apply>
  bool advance(HeightField& bed, const Apply& apply) {
    for_each_tile(apply);
    activity_.advance(bed, [this](int slot) {
      return TileActivity::Changed{tile(slot).changed, tile(slot).flow.rows};
    });
    return !at_rest();
  }

  /// Writes the heights after the passes so far to the bed.
  void write_back(HeightField& bed) const;

  /// Between relaxations.
  void visit_state(StateVisitor& state);

  /// Heap memory for each tile that takes part in a relaxation [bytes].
  static constexpr std::size_t bytes_per_tile() {
    return sizeof(RelaxedTile) + sizeof(PatchHeights) + sizeof(int) + sizeof(Residuals) + sizeof(double) +
           TileActivity::bytes_per_tile();
  }

  /// Ends a relaxation: writes the heights back, and fills in the residual of the whole bed and the counters
  /// since begin(). Only tiles that take part are looked at, so the flow of the active ones must have been
  /// computed.
  void end(HeightField& bed, RelaxationOutcome& outcome);

 private:
  template <class Body>
  void for_active_tiles(const Body& body) const {
    parallel_for(tiles().size(), work_ >= worth_threads_, [&](std::size_t i) { body(tiles()[i]); });
  }
  void know_slots(int count);
  void measure_residuals(const TilePatch& patch, const GroundPatch* ground, const CellFlags& cells);
  void look_at_floor(const HeightField& bed);
  void wake_too_steep(HeightField& bed);
  void take_part(const HeightField& bed, int slot);
  void load_slope_weights(int tile, std::unique_ptr<TilePatch>& weights);
  void look_at_active_cells();
  void load_rim(const HeightField& bed, TilePatch& patch, RowSpan rows, const CellFlags& cells) const;
  void load_givers(const HeightField& bed, int slot, RowSpan rows, FlowScratch& scratch) const;

  TalusLaw law_;
  double tolerance_;
  std::int64_t worth_threads_;
  double stable_slope_;  // rise over run
  HeightField* talus_factors_;
  bool looks_at_all_;        // at the next begin()
  bool near_level_ = false;  // sand is, or was, as low as the level of the ground's floor
  TileActivity activity_;

  // Tiles of this relaxation, by number. Those beyond joined_ are left from earlier ones.
  BorrowedScratch<RelaxedTile> tiles_;
  std::size_t joined_ = 0;
  Scratch<std::vector<int>> numbers_;  // per slot; -1: takes no part, as all between relaxations
  // Residual of each group of cells, per slot, and the largest per slot, after the last relaxation that saw
  // them.
  using Residuals = std::array<double, HeightField::tile_area / cells_per_group>;
  std::vector<SharedUntilWritten<Residuals>> group_residuals_;
  std::vector<double> residuals_;

  std::int64_t active_cells_ = 0, work_ = 0, cells_visited_ = 0, wake_ups_before_ = 0;
  int tiles_active_max_ = 0;
};

template <class InStep, class Join>
double ActiveSand::compute_flow(HeightField& bed, const InStep& in_step, const Join& join) {
  for (const int slot : tiles()) {
    take_part(bed, slot);
    join(slot);
  }
  look_at_active_cells();
  // The next height of a cell depends on cells up to two away.
  const auto seen_rows = [&](int slot) {
    const RowSpan rows = activity_.rows(slot);
    return RowSpan{rows.begin - TilePatch::rim, rows.end + TilePatch::rim};
  };
  for_active_tiles([&](int slot) { tile(slot).patch.load_rows(bed, seen_rows(slot)); });
  for_active_tiles([&](int slot) {
    RelaxedTile& one = tile(slot);
    load_rim(bed, one.patch, seen_rows(slot), cells(slot));
    FlowScratch& scratch = FlowScratch::of_this_thread();
    FlowInStep step = in_step(slot, one);
    step.slope_weights = one.slope_weights.get();
    step.ground = one.ground.get();
    if (step.first) load_givers(bed, slot, activity_.rows(slot), scratch);
    sandstroke::compute_flow(law_, one.patch, cells(slot), activity_.rows(slot), step, scratch, one.flow);
  });
  CompensatedSum given;
  for (const int slot : tiles()) given.add(tile(slot).flow.given);
  return given.value();
}

// One relaxer per method.
std::unique_ptr<Relaxer> make_plain_relaxer(const RelaxationSettings& settings, double cell_size);
std::unique_ptr<Relaxer> make_tile_relaxer(const RelaxationSettings& settings, double cell_size);
std::unique_ptr<Relaxer> make_multilevel_relaxer(const RelaxationSettings& settings, double cell_size);

/// How far a relaxation by super-steps has come, between its parts.
struct SuperStepProgress {
  double travelled = 0.0;  ///< m: how far sand has moved
  /// c of the next super-step, as a part of the largest. It doubles from step to step, so that a violent
  /// start has small steps.
  double part_of_share = 1.0 / 8.0;
};
/// rkl.
class SuperStepper : public Relaxer {
 public:
  virtual std::unique_ptr<SuperStepper> copy_stepper() const = 0;
  std::unique_ptr<Relaxer> copy() const final { return copy_stepper(); }
  /// When a part ends: after so many passes, once so many cells are awake; at the latest after most_passes.
  struct Part {
    std::int64_t passes, awake_cells, most_passes;
  };
  /// Goes on with a relaxation. What still moves at the part's end stays awake for the next one. after_pass
  /// counts from this part's beginning.
  virtual RelaxationOutcome relax_part(HeightField& bed, SuperStepProgress& progress, const Part& part,
                                       const PassWatcher& after_pass) = 0;
  /// Slots of the tiles whose sand is awake.
  virtual const std::vector<int>& awake_tiles() const = 0;
};
std::unique_ptr<SuperStepper> make_super_stepper(const RelaxationSettings& settings, double cell_size,
                                                 const SandStart& start = {});
/// Heap memory [bytes] of the rkl relaxer besides ActiveSand, for each tile that takes part.
std::size_t rkl_bytes_per_tile();

}  // namespace sandstroke
