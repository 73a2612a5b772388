// Super time stepping: first-order Runge-Kutta-Legendre steps (Meyer, Balsara & Aslam, MNRAS 422, 2012) whose
// length is not fixed in advance. At its stability limit c, the scheme of s stages is
//   Y(j+1) = Y(j) + j/(j+1) (Y(j) - Y(j-1)) + c (2j+1)/(j+1) F(Y(j)).
// It does not contain s: every Y(j) is the end of a valid step of length c j(j+1)/2, while j plain passes
// would reach c j. So stages go on until F(Y(j)), which the next one needs anyway, says stop. Nothing is
// computed for the controller alone.
//   e = tau/2 max|F - F0| / (travelled + tau max|F0|), expected for the next stage, is the error of the step
//   relative to how far sand has moved in this relaxation. It stays below the step tolerance. A step also
//   ends when the flow has decayed or turned against its start (sum F F0 < 2 % of sum F0^2), because momentum
//   would carry sand too far.
// Sand flows in the stages wherever the slope exceeds tan(talus); the tolerance only says when all is done.
// (If the stages used the tolerance, its jumps would make long steps chatter.) But only cells within one of a
// change give. All other sand stays; otherwise a grain that falls on a heap at rest would set its whole
// surface flowing within the tolerance. (A plane so steep everywhere that its cells pass on what they take
// also stays, until the change at its ends comes near. The result is then 0.9 % of the moved sand from the
// small-step limit, instead of 0.5.)
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/compensated_sum.h"
#include "core/interrupt.h"
#include "sand/active_sand.h"
#include "sand/flux_tile.h"
#include "sand/super_step_kernels.h"

namespace sandstroke {
namespace {

// These constants were found on cones, rough beds and furrows (checked by tests/accuracy and tests/bench). c:
// the isotropic law's limit. It also keeps the paper's law near its small steps.
constexpr double largest_share = 0.25;
double share_of(const RelaxationSettings& settings) { return std::min(flow_share(settings), largest_share); }
// A step ends when sum F F0 falls below this fraction of sum F0^2. 0.05 takes a tenth more passes; with 0
// momentum carries sand too far.
constexpr double decayed = 0.02;

// Sweeps over this work [cells] or more wait for memory. Then, if the expected error lets a step go on, its
// next stage is taken in the same sweep as the flow, and dropped if the step ends after all. 32 bytes a cell
// pass instead of 72, with the same bits.
constexpr std::int64_t work_worth_ahead = 20'000;

/// The law inside a super-step: no tolerance, and its flow F is for c = 1.
TalusLaw ungated(const RelaxationSettings& settings, double cell_size) {
  RelaxationSettings law = settings;
  law.tolerance = 0.0;
  law.share = 1.0;
  TalusLaw inside = talus_law(law, cell_size);
  inside.most_given = 1.0 / share_of(settings);
  return inside;
}

class RklRelaxer : public SuperStepper {
 public:
  RklRelaxer(const RelaxationSettings& settings, double cell_size, const SandStart& start)
      : law_(talus_law(settings, cell_size)),
        step_tolerance_(settings.step_tolerance),
        max_passes_(settings.max_passes),
        largest_share_(share_of(settings)),
        sand_(ungated(settings, cell_size), settings.tolerance, cell_size, Givers::near_changes, start) {}

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    SuperStepProgress progress;
    return relax_part(bed, progress, {max_passes_, 0, max_passes_}, after_pass);
  }

  RelaxationOutcome relax_part(HeightField& bed, SuperStepProgress& progress, const Part& part,
                               const PassWatcher& after_pass) override {
    part_ = part;
    outcome_ = {};
    moved_ = {};
    low_ = std::numeric_limits<double>::infinity();
    high_ = -low_;
    ++step_;
    taken_in_ = 0;
    travelled_ = progress.travelled;
    too_steep_ = in_fluxes_ = false;
    const BedNow bed_now = [&]() -> const HeightField& {
      sand_.write_back(bed);
      return bed;
    };
    const auto told = [&] {
      if (after_pass) after_pass(outcome_.passes, bed_now);
    };
    double share = largest_share_ * progress.part_of_share;
    sand_.begin(bed);
    tiles_.begin();
    if (!sand_.at_rest()) compute_flow(bed);
    while (goes_on()) {
      super_step(bed, share, told);
      share = std::min(2.0 * share, largest_share_);
    }
    progress = {travelled_, share / largest_share_};
    if (!too_steep_) sand_.rest();
    outcome_.moved_volume = moved_.value() * bed.cell_area();
    sand_.end(bed, outcome_);
    tiles_.end();
    return outcome_;
  }

  std::unique_ptr<SuperStepper> copy_stepper() const override { return std::make_unique<RklRelaxer>(*this); }
  void visit_state(StateVisitor& state) override { sand_.visit_state(state); }
  const std::vector<int>& awake_tiles() const override { return sand_.tiles(); }

  struct StepTile {
    SuperStepTile kept;
    FlowSize first{};                // size of F0, if the tile is active at the step's start
    HeightRange range{};             // heights of the active cells after the last stage
    std::int64_t step = -1;          // the last super-step that it took part in
    std::int64_t pass = -1;          // the last pass in which it was active
    std::unique_ptr<FluxTile> flux;  // over a floor
  };

 private:
  bool goes_on() const {
    const bool ends = outcome_.passes >= part_.most_passes ||
                      (outcome_.passes >= part_.passes && sand_.active_cells() >= part_.awake_cells);
    return !sand_.at_rest() && too_steep_ && !ends && !interrupted();
  }
  StepTile& tile(int slot) { return tiles_[sand_.number_of(slot)]; }

  template <class Told>
  void super_step(HeightField& bed, double share, const Told& told) {
    ++step_;
    ++outcome_.super_steps;
    const FlowSize first = start_step();
    double tau = 0.0, flowing = 0.0;
    double foreseen = std::numeric_limits<double>::infinity();  // error expected after the next stage
    bool ahead = false;                                         // the next stage is already taken
    for (int j = 0;; ++j) {
      const Stage stage = stage_of(j, share);
      if (!(ahead ? go_ahead(bed) : advance(bed, stage))) break;  // the flow that is left is below rounding
      ++outcome_.passes;
      told();
      if (j > 0 && left_range()) {
        take_back(bed);
        break;
      }
      flowing = stage.momentum * flowing + stage.step * given_;
      moved_.add(flowing);
      tau = share * (j + 1.0) * (j + 2.0) / 2.0;
      const double growth = (j + 3.0) / (j + 1.0);  // tau's, in the next stage
      const double squared = growth * growth;       // of the error
      ahead = !in_fluxes_ && sand_.work() >= work_worth_ahead && foreseen * squared <= step_tolerance_;
      if (ahead)
        compute_flow(bed, stage_of(j + 1, share));
      else
        compute_flow(bed);
      if (!goes_on()) break;
      const FlowChange change = change_from_start();
      foreseen = 0.5 * tau * change.difference / (travelled_ + tau * first.peak) * squared;
      if (foreseen > step_tolerance_ || change.product <= decayed * first.square) {
        if (ahead) compute_flow(bed);  // computes the gains, for the next step
        break;
      }
    }
    travelled_ += tau * first.peak;
  }

  struct Stage {
    double momentum, step;
  };
  static Stage stage_of(int j, double share) { return {j / (j + 1.0), share * (2.0 * j + 1.0) / (j + 1.0)}; }

  /// Computes F of the current heights, how it differs from F0, and whether any slope is beyond the
  /// tolerance. ahead: takes the stage that will be next if the step goes on, instead of keeping the gains.
  void compute_flow(HeightField& bed, const std::optional<Stage>& ahead = {}) {
    const auto in_step = [&](int slot, RelaxedTile& relaxed) {
      StepTile& one = tile(slot);
      FlowInStep step{&one.kept.first};
      if (one.flux) step.fluxes = &one.flux->flow;
      if (ahead)
        step.ahead.emplace(StageAhead{ahead->momentum, ahead->step, one.kept, relaxed.changed, one.range});
      return step;
    };
    given_ = sand_.compute_flow(bed, in_step, [&](int slot) { take_in(bed, slot); });
    too_steep_ = false;
    for (const int slot : sand_.tiles()) {
      const TileFlow& flow = sand_.tile(slot).flow;
      too_steep_ |= flow.axis_drop > law_.axis_limit || flow.diagonal_drop > law_.diagonal_limit;
    }
  }

  /// Lets an active tile join the step, and adds its starting heights to the range.
  void take_in(const HeightField& bed, int slot) {
    if (tiles_.size() < sand_.joined()) tiles_.add();
    if (taken_in_ < sand_.joined()) {  // the tile is new in this relaxation
      ++taken_in_;
      tile(slot).step = -1;
      const RelaxedTile& relaxed = sand_.tile(slot);
      if (!relaxed.ground || !relaxed.ground->has_floor)
        tile(slot).flux.reset();
      else if (!tile(slot).flux)
        tile(slot).flux = std::make_unique<FluxTile>();
      in_fluxes_ |= tile(slot).flux != nullptr;
      const CellRange cells = bed.tile_cells(bed.tile_of(slot));
      const HeightRange range = range_of(bed.tile_heights(slot), cells.rows(), cells.cols());
      low_ = std::min(low_, range.low);
      high_ = std::max(high_, range.high);
    }
    join(slot);
  }
  void join(int slot) {
    StepTile& joining = tile(slot);
    joining.pass = outcome_.passes;
    if (joining.step == step_) return;
    joining.step = step_;
    joining.kept.stepped = joining.kept.same = joining.kept.first.moved = {};
    joining.kept.rows = joining.kept.first.rows = {};
    if (joining.flux) joining.flux->stage.clear();
  }

  /// Keeps the flow as F0. Returns its size.
  FlowSize start_step() {
    for (const int slot : sand_.tiles()) join(slot);
    sand_.for_each_tile([this](int slot, RelaxedTile& relaxed) {
      tile(slot).first = keep_first_flow(relaxed.flow, tile(slot).kept.first);
    });
    double peak = 0.0;
    CompensatedSum square;
    for (const int slot : sand_.tiles()) {
      peak = std::max(peak, tile(slot).first.peak);
      square.add(tile(slot).first.square);
    }
    return {peak, square.value()};
  }

  struct FlowChange {
    double difference;  // m: max |F - F0|
    double product;     // m^2: sum F F0
  };
  /// How the last computed flow differs from F0. A tile that flowed at the step's start stays active until
  /// the step ends, even if its flow is over: its momentum still moves it.
  FlowChange change_from_start() const {
    double difference = 0.0;
    CompensatedSum product;
    for (const int slot : sand_.tiles()) {
      difference = std::max(difference, sand_.tile(slot).flow.change);
      product.add(sand_.tile(slot).flow.product);
    }
    return {difference, product.value()};
  }

  /// Takes one stage. Returns false if no height changed: all is at rest.
  bool advance(HeightField& bed, const Stage& stage) {
    if (in_fluxes_)
      sand_.for_each_tile([&](int slot, RelaxedTile&) {
        if (tile(slot).flux) advance_fluxes(stage.momentum, stage.step, *tile(slot).flux);
      });
    const bool moves = sand_.advance(bed, [&](int slot, RelaxedTile& relaxed) {
      StepTile& one = tile(slot);
      one.range = one.flux
                      ? flux_stage(fluxes_around(bed, slot), *relaxed.ground, sand_.cells(slot),
                                   relaxed.flow.rows, *one.flux, relaxed.patch, one.kept, relaxed.changed)
                      : super_stage(relaxed.flow, sand_.cells(slot), stage.momentum, stage.step,
                                    relaxed.patch, one.kept, relaxed.changed);
    });
    if (in_fluxes_)  // only now, since neighbours read D
      for_tiles_in_step([this](RelaxedTile&, StepTile& one) {
        if (one.flux && one.pass == outcome_.passes) one.flux->stage.swap(one.flux->flow);
      });
    return moves;
  }
  FluxesAround fluxes_around(const HeightField& bed, int slot) {
    FluxesAround around{};
    for (int at = 0; at < 9; ++at) {
      const int beside = bed.tile_beside(bed.tile_of(slot), at / 3 - 1, at % 3 - 1);
      const int other = beside < 0 ? -1 : bed.slot_of(beside);
      if (other < 0 || !sand_.takes_part(other) || sand_.number_of(other) >= taken_in_) continue;
      StepTile& one = tile(other);
      if (one.flux && one.step == step_) around[static_cast<std::size_t>(at)] = &one.flux->stage;
    }
    return around;
  }
  /// The same, with the stage that was already taken with the flow.
  bool go_ahead(HeightField& bed) {
    return sand_.advance(
        bed, [&](int slot, RelaxedTile& relaxed) { relaxed.patch.exchange(tile(slot).kept.before); });
  }

  /// Calls body(tile, its step's tile) for the tiles that take part in this super-step.
  template <class Body>
  void for_tiles_in_step(const Body& body) {
    for (std::size_t number = 0; number < taken_in_; ++number)
      if (tiles_[number].step == step_) body(sand_.tile_at(number), tiles_[number]);
  }

  /// Whether the last stage took any height out of the range of the starting ones.
  bool left_range() {
    bool left = false;
    for_tiles_in_step([&](RelaxedTile&, const StepTile& one) {
      left |= one.pass == outcome_.passes - 1 && (one.range.low < low_ || one.range.high > high_);
    });
    return left;
  }

  void take_back(HeightField& bed) {
    ++outcome_.rejected_stages;
    for_tiles_in_step(
        [](RelaxedTile& relaxed, const StepTile& one) { take_back_stage(one.kept, relaxed.patch); });
    compute_flow(bed);
  }

  TalusLaw law_;  // decides what rests
  double step_tolerance_;
  std::int64_t max_passes_;
  double largest_share_;
  ActiveSand sand_;

  BorrowedScratch<StepTile> tiles_;  // by number in sand_
  std::int64_t step_ = 0;            // which super-step this is

  // State of this relaxation, or of this part of it.
  Part part_{};
  RelaxationOutcome outcome_;
  std::size_t taken_in_ = 0;  // how many tiles have taken part
  CompensatedSum moved_;
  double low_ = 0.0, high_ = 0.0;  // m: range of the starting heights, in the tiles that took part
  double travelled_ = 0.0;         // m: how far sand has moved: the sum of tau max |F0|
  double given_ = 0.0;             // m: sum of outflows of F
  bool too_steep_ = false;
  bool in_fluxes_ = false;  // some tile takes its super-steps in flux form
};

}  // namespace

std::size_t rkl_bytes_per_tile() { return sizeof(RklRelaxer::StepTile) + sizeof(PatchHeights); }

std::unique_ptr<SuperStepper> make_super_stepper(const RelaxationSettings& settings, double cell_size,
                                                 const SandStart& start) {
  return std::make_unique<RklRelaxer>(settings, cell_size, start);
}

}  // namespace sandstroke
