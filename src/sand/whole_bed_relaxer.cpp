#include "sand/whole_bed_relaxer.h"

#include <optional>

#include "core/interrupt.h"
#include "sand/active_sand.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

/// The rule as it is written down. The other relaxers must do as it does.
class PlainRelaxer : public WholeBedRelaxer {
 public:
  PlainRelaxer(const RelaxationSettings& settings, double cell_size)
      : WholeBedRelaxer(settings.max_passes), law_(talus_law(settings, cell_size)) {}
  std::unique_ptr<Relaxer> copy() const override { return std::make_unique<PlainRelaxer>(*this); }
  void visit_state(StateVisitor& /*state*/) override {}

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    ground_.reset();
    if (bed.ground()) ground_ = talus_ground(*bed.ground());
    return WholeBedRelaxer::relax(bed, after_pass);
  }

 protected:
  TalusPass pass(const HeightGrid& heights, const WallGrid& walls, CompensatedSum& moved) const override {
    return talus_pass(heights, walls, ground_ ? &*ground_ : nullptr, law_, moved);
  }

 private:
  TalusLaw law_;
  std::optional<TalusGround> ground_;  // of the bed that is being relaxed
};

}  // namespace

RelaxationOutcome WholeBedRelaxer::relax(HeightField& bed, const PassWatcher& after_pass) {
  RelaxationOutcome outcome;
  outcome.tiles_active_max = bed.tile_count();
  HeightGrid heights = bed.grid();
  WallGrid walls(bed.rows(), bed.cols());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) walls(row, col) = bed.is_wall(row, col);
  const BedNow bed_now = [&]() -> const HeightField& {
    bed.set_changed(heights);
    return bed;
  };
  CompensatedSum moved;
  while (true) {
    CompensatedSum moved_then = moved;
    TalusPass next = pass(heights, walls, moved_then);
    outcome.cells_visited += heights.size();
    outcome.residual = next.residual;
    outcome.converged = !next.flows;
    if (outcome.converged || outcome.passes == max_passes_ || interrupted()) break;
    moved = moved_then;
    outcome.converged = (next.heights == heights).all();  // the flow that is left is below rounding
    if (outcome.converged) break;
    heights.swap(next.heights);
    ++outcome.passes;
    if (after_pass) after_pass(outcome.passes, bed_now);
  }
  outcome.moved_volume = moved.value() * bed.cell_area();
  bed.set_changed(heights);
  bed.clear_disturbed();
  return outcome;
}

std::unique_ptr<Relaxer> make_plain_relaxer(const RelaxationSettings& settings, double cell_size) {
  return std::make_unique<PlainRelaxer>(settings, cell_size);
}

}  // namespace sandstroke
