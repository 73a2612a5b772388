#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/parallel.h"
#include "sand/flow_kernels.h"
#include "sand/relaxation.h"
#include "sand/tile_activity.h"

namespace sandstroke {

/// The sand of a bed that can move, and one law's flow in it: what the steppers (passes, rkl) are made of. A
/// pass is compute_flow, then advance: two sweeps over the active tiles, on more threads where that pays,
/// with the same bits for any number of them.
class ActiveSand {
 public:
  // Passes with less work go on one thread: handing out tiles would cost more than it saves. In cells; a tile
  // with any active ones costs as much as 400 more (measured: tests/bench/active_sand_bench.cpp).
  static constexpr std::int64_t work_worth_threads = 8'000, work_per_tile = 400;

  /// holds_still: only cells within one of a change may give; all others are held still, however steep.
  ActiveSand(const TalusLaw& law, double cell_size, bool holds_still = false,
             std::int64_t worth_threads = work_worth_threads);

  /// Takes up what was set since the last relaxation.
  void begin(HeightField& bed);
  bool at_rest() const { return activity_.tiles().empty(); }
  const std::vector<int>& tiles() const { return activity_.tiles(); }  ///< active ones, by slot
  const CellFlags& cells(int slot) const { return activity_.cells(slot); }
  void rest() { activity_.rest(); }  ///< nothing is active any more

  /// Every active cell's gain in a pass. then(slot, flow), if given, is called for each active tile, from any
  /// thread. Returns the sum of outflows [m].
  double compute_flow(const HeightField& bed, const std::function<void(int, const TileFlow&)>& then = {});
  /// As computed last for tiles()[i].
  const TileFlow& flow(std::size_t i) const { return *flows_[i]; }
  /// body(slot, flow) for each active tile.
  template <class Body>
  void for_each_tile(const Body& body) const {
    for_active_tiles([&](std::size_t i) { body(tiles()[i], flow(i)); });
  }

  /// Calls apply(slot, flow, changed) for each active tile: it changes the tile's heights, flags in
  /// `changed` the cells that are another number now, and returns whether there is one. Next active: the
  /// cells that see a change. False where nothing changed, and nothing is active.
  template <class Apply>
  bool advance(HeightField& bed, const Apply& apply) {
    for_active_tiles([&](std::size_t i) {
      const int slot = activity_.tiles()[i];
      any_changed_[i] = apply(slot, *flows_[i], changed_[i]);
    });
    activity_.advance(bed, changed_, any_changed_);
    return !at_rest();
  }

  /// Heap memory for each tile that has been active at once with all others [bytes].
  static constexpr std::size_t bytes_per_tile() {
    return sizeof(TileFlow) + sizeof(CellFlags) + sizeof(Look) + TileActivity::bytes_per_tile();
  }

  /// Ends a relaxation: residual of the whole bed, and the counters since begin(). The flow of what is still
  /// active must have been computed: that is where it is looked at.
  void end(const HeightField& bed, RelaxationOutcome& outcome);

 private:
  template <class Body>
  void for_active_tiles(const Body& body) const {
    parallel_for(tiles().size(), work_ >= worth_threads_, body);
  }
  void load_givers(const HeightField& bed, int slot, GiverFlags& givers) const;
  std::int64_t look_at_active_cells();

  TalusLaw law_;
  bool holds_still_;
  std::int64_t worth_threads_;
  double stable_slope_;  // rise over run
  TileActivity activity_;

  std::vector<std::unique_ptr<TileFlow>> flows_;  // per active tile, as are the next two
  std::vector<CellFlags> changed_;
  std::vector<char> any_changed_;

  struct Look {
    CellFlags cells{};  // active at some time in this relaxation
    // Residual of each group.
    std::array<double, HeightField::tile_area / cells_per_group> steepest{};
    bool listed = false;  // in looked_at_
  };
  std::vector<Look> looks_;        // per slot
  std::vector<double> residuals_;  // per slot, after the relaxation before
  std::vector<int> looked_at_;

  std::int64_t work_ = 0, cells_visited_ = 0, wake_ups_before_ = 0;
  int tiles_active_max_ = 0;
};

// Those steppers.
std::unique_ptr<Relaxer> make_tile_relaxer(const RelaxationSettings& settings, double cell_size);
std::unique_ptr<Relaxer> make_rkl_relaxer(const RelaxationSettings& settings, double cell_size);
/// Heap memory that the latter takes besides ActiveSand for each tile that has been active [bytes].
std::size_t rkl_bytes_per_tile();

}  // namespace sandstroke
