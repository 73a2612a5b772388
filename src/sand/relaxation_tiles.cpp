// Relaxes only the cells that can move, tile by tile, with the same bits as PlainRelaxer
// (whole_bed_relaxer.cpp).
#include "core/compensated_sum.h"
#include "core/interrupt.h"
#include "sand/active_sand.h"

namespace sandstroke {
namespace {

class TileRelaxer : public Relaxer {
 public:
  TileRelaxer(const RelaxationSettings& settings, double cell_size)
      : max_passes_(settings.max_passes),
        sand_(talus_law(settings, cell_size), settings.tolerance, cell_size) {}
  std::unique_ptr<Relaxer> copy() const override { return std::make_unique<TileRelaxer>(*this); }
  void visit_state(StateVisitor& state) override { sand_.visit_state(state); }

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    RelaxationOutcome outcome;
    CompensatedSum moved;
    const BedNow bed_now = [&]() -> const HeightField& {
      sand_.write_back(bed);
      return bed;
    };
    sand_.begin(bed);
    while (!sand_.at_rest() && outcome.passes != max_passes_ && !interrupted()) {
      moved.add(compute_flow(bed));
      const bool changed = sand_.advance(bed, [](int, RelaxedTile& tile) {
        apply_flow(tile.flow, tile.ground.get(), tile.patch, tile.changed);
      });
      if (!changed) break;  // the flow that is left is below rounding
      ++outcome.passes;
      if (after_pass) after_pass(outcome.passes, bed_now);
    }
    if (!sand_.at_rest()) look_for_rest(bed);  // cut off: perhaps the last pass was enough
    outcome.moved_volume = moved.value() * bed.cell_area();
    sand_.end(bed, outcome);
    return outcome;
  }

 private:
  double compute_flow(HeightField& bed) {
    return sand_.compute_flow(
        bed, [](int, RelaxedTile&) { return FlowInStep{}; }, [](int) {});
  }
  void look_for_rest(HeightField& bed) {
    compute_flow(bed);
    for (const int slot : sand_.tiles()) {
      const TileFlow& flow = sand_.tile(slot).flow;
      if (columns_of(flow.moved, flow.rows)) return;
    }
    sand_.rest();
  }

  std::int64_t max_passes_;
  ActiveSand sand_;
};

}  // namespace

std::unique_ptr<Relaxer> make_tile_relaxer(const RelaxationSettings& settings, double cell_size) {
  return std::make_unique<TileRelaxer>(settings, cell_size);
}

}  // namespace sandstroke
