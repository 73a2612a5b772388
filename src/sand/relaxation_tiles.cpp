// Relaxes only the cells that can move, tile by tile; the same bits as the reference.
#include "core/compensated_sum.h"
#include "core/interrupt.h"
#include "sand/active_sand.h"

namespace sandstroke {
namespace {

class TileRelaxer : public Relaxer {
 public:
  TileRelaxer(const RelaxationSettings& settings, double cell_size)
      : max_passes_(settings.max_passes), sand_(TalusLaw(settings, cell_size), cell_size) {}

  RelaxationOutcome relax(HeightField& bed, const std::function<void(std::int64_t)>& after_pass) override {
    RelaxationOutcome outcome;
    CompensatedSum moved;
    sand_.begin(bed);
    while (!sand_.at_rest() && outcome.passes != max_passes_ && !interrupted()) {
      moved.add(sand_.compute_flow(bed));
      const bool changed = sand_.advance(bed, [&bed](int slot, const TileFlow& flow, CellFlags& cells) {
        if (!apply_flow(flow, bed.tile_heights(slot), cells)) return false;
        bed.mark_changed(slot);
        return true;
      });
      if (!changed) break;  // what still flows is below rounding
      ++outcome.passes;
      if (after_pass) after_pass(outcome.passes);
    }
    if (!sand_.at_rest()) look_for_rest(bed);  // cut off: perhaps the last pass was enough
    outcome.moved_volume = moved.value() * bed.cell_area();
    sand_.end(bed, outcome);
    return outcome;
  }

 private:
  void look_for_rest(const HeightField& bed) {
    sand_.compute_flow(bed);
    for (std::size_t i = 0; i < sand_.tiles().size(); ++i)
      if (any(sand_.flow(i).moved)) return;
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
