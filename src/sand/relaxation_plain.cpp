// Relaxes the whole bed by the rule as it is written down (rules/talus.h). Tests compare the other relaxers
// with it.
#include "core/interrupt.h"
#include "sand/active_sand.h"

namespace sandstroke {
namespace {

class PlainRelaxer : public Relaxer {
 public:
  PlainRelaxer(const RelaxationSettings& settings, double cell_size)
      : law_(talus_law(settings, cell_size)), max_passes_(settings.max_passes) {}

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    RelaxationOutcome outcome;
    outcome.tiles_active_max = bed.tile_count();
    HeightGrid heights = bed.grid();
    WallGrid walls(bed.rows(), bed.cols());
    for (int row = 0; row < bed.rows(); ++row)
      for (int col = 0; col < bed.cols(); ++col) walls(row, col) = bed.is_held(row, col);
    const BedNow bed_now = [&]() -> const HeightField& {
      write_back(heights, bed);
      return bed;
    };
    CompensatedSum moved;
    while (true) {
      CompensatedSum moved_then = moved;
      TalusPass pass = talus_pass(heights, walls, law_, moved_then);
      outcome.cells_visited += heights.size();
      outcome.residual = pass.residual;
      // Without a change, what still flows is below rounding.
      outcome.converged = !pass.flows;
      if (outcome.converged || outcome.passes == max_passes_ || interrupted()) break;
      moved = moved_then;
      outcome.converged = (pass.heights == heights).all();
      if (outcome.converged) break;
      heights.swap(pass.heights);
      ++outcome.passes;
      if (after_pass) after_pass(outcome.passes, bed_now);
    }
    outcome.moved_volume = moved.value() * bed.cell_area();
    write_back(heights, bed);
    bed.clear_disturbed();
    return outcome;
  }

 private:
  static void write_back(const HeightGrid& heights, HeightField& bed) {
    for (int row = 0; row < bed.rows(); ++row)
      for (int col = 0; col < bed.cols(); ++col)
        if (bed(row, col) != heights(row, col)) bed.set(row, col, heights(row, col));
  }

  TalusLaw law_;
  std::int64_t max_passes_;
};

}  // namespace

std::unique_ptr<Relaxer> make_plain_relaxer(const RelaxationSettings& settings, double cell_size) {
  return std::make_unique<PlainRelaxer>(settings, cell_size);
}

}  // namespace sandstroke
