// Super-steps on the bed, and between them corrections from coarser ones. On n cells across, what must move
// far takes about n passes; here that is done where n is small, and the cost is linear in the cells.
#include "core/interrupt.h"
#include "sand/active_sand.h"
#include "sand/coarse_sand.h"

namespace sandstroke {
namespace {

// Sand that moves far on a coarse bed does not take the ways that it takes on the fine one, and it never
// comes back. So the fine bed goes first. With 64 first passes hills come to rest with 3.7 % of the moved
// sand elsewhere, with 128 2.2 %, with 256 1.4 to 1.9 % (512^2; `rkl` 0.1 %; piles 0.1 %). Few passes on the
// coarse beds at a time would bring it below 0.3 %, and cost more than `rkl` does.
constexpr std::int64_t first_passes = 256, first_coarse_passes = 128, passes_between = 32;
/// More gain nothing.
constexpr int most_corrections = 4;
/// Passes on a coarse bed at a time. Sand that rests later there is brought back as far as it came.
constexpr std::int64_t most_coarse_passes = 1024;
/// Fewer awake cells than these are not helped: those of a stroke on 4000^2 took twice as long with
/// corrections.
constexpr std::int64_t least_awake = 10'000;
/// Cells across a bed from which on it has a coarse one.
constexpr int least_cells = 128;
/// Part of the largest share after a correction.
constexpr double share_after = 0.25;

class MultilevelRelaxer : public Relaxer {
 public:
  MultilevelRelaxer(const RelaxationSettings& settings, double cell_size, const SandStart& start)
      : settings_(settings),
        talus_factors_(start.talus_factors),
        stepper_(make_super_stepper(settings, cell_size, start)) {}
  MultilevelRelaxer(const MultilevelRelaxer& other)
      : settings_(other.settings_),
        talus_factors_(other.talus_factors_),
        stepper_(other.stepper_->copy_stepper()) {}
  std::unique_ptr<Relaxer> copy() const override { return std::make_unique<MultilevelRelaxer>(*this); }
  void visit_state(StateVisitor& state) override { stepper_->visit_state(state); }

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    return relax(bed, 0.0, after_pass);
  }

 private:
  /// travelled [m]: how far sand has moved already.
  RelaxationOutcome relax(HeightField& bed, double travelled, const PassWatcher& after_pass) {
    SuperStepProgress progress{.travelled = travelled};
    RelaxationOutcome outcome;
    const auto take = [&](std::int64_t passes) {
      const std::int64_t before = outcome.passes;
      const PassWatcher watcher = [&](std::int64_t more, const BedNow& bed_now) {
        after_pass(before + more, bed_now);
      };
      outcome.add(stepper_->relax_part(bed, progress, {passes, least_awake, settings_.max_passes - before},
                                       after_pass ? watcher : PassWatcher{}));
    };
    // A coarse cell cannot be half a wall, or half a stone.
    const bool has_walls = bed.shape() != BedShape::rectangle || !bed.tool_walls().empty();
    const bool has_coarse = !has_walls && !bed.ground() && std::min(bed.rows(), bed.cols()) >= least_cells;
    const bool is_coarse = talus_factors_ != nullptr;
    take(!has_coarse ? settings_.max_passes : is_coarse ? first_coarse_passes : first_passes);
    bool far_from_rest = true;
    for (int corrections = 0; !outcome.converged && outcome.passes < settings_.max_passes && !interrupted();
         ++corrections) {
      bool corrected = false;
      if (corrections < most_corrections) {
        corrected = correct(bed, far_from_rest, progress.travelled, outcome);
        if (!corrected && far_from_rest) corrected = correct(bed, false, progress.travelled, outcome);
        far_from_rest = false;
      }
      if (corrected) progress.part_of_share = share_after;
      take(corrected ? passes_between : settings_.max_passes);
    }
    return outcome;
  }

  /// Relaxes the coarse bed and brings back what changed. Returns false where that would not help.
  bool correct(HeightField& bed, bool first, double travelled, RelaxationOutcome& outcome) const {
    CoarseSand coarse(bed, settings_, stepper_->awake_tiles(), talus_factors_, first);
    if (!coarse.flows()) return false;
    RelaxationSettings settings = on_coarse_bed(settings_);
    settings.max_passes = most_coarse_passes;
    MultilevelRelaxer relaxer(settings, coarse.bed().cell_size(),
                              {FirstWake::disturbed, &coarse.talus_factors()});
    const RelaxationOutcome there = relaxer.relax(coarse.bed(), travelled, {});
    outcome.cells_visited += there.cells_visited;
    outcome.moved_volume += 2.0 * there.moved_volume;  // through a coarse cell: two fine ones
    coarse.bring_back(bed);
    return true;
  }

  RelaxationSettings settings_;
  HeightField* talus_factors_;
  std::unique_ptr<SuperStepper> stepper_;
};

}  // namespace

std::unique_ptr<Relaxer> make_multilevel_relaxer(const RelaxationSettings& settings, double cell_size) {
  return std::make_unique<MultilevelRelaxer>(settings, cell_size, SandStart{});
}

}  // namespace sandstroke
