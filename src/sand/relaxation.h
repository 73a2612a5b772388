#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/error.h"
#include "core/state_visitor.h"
#include "rules/schedule.h"
#include "rules/talus.h"
#include "sand/height_field.h"

namespace sandstroke {

inline constexpr const char* relaxation_law_names[] = {"paper", "isotropic", "faces"};
/// passes: Jacobi passes of the law over the sand that can move. rkl: super time steps, which reach the rest
/// of many small steps of the law in far fewer passes (relaxation_rkl.cpp). plain: talus_pass over all cells;
/// slow, with the same bits as `passes`. Start there to write a law of your own. multilevel: rkl, helped by
/// coarser beds where sand must move far (relaxation_multilevel.cpp); isotropic and faces only, and rkl alone
/// on beds with walls or on a ground (sand/ground.h). Over a floor, `paper` takes no super-steps.
enum class RelaxationMethod { passes, rkl, multilevel, plain };
inline constexpr const char* relaxation_method_names[] = {"passes", "rkl", "multilevel", "plain"};
/// Whether a method takes super-steps.
constexpr bool takes_super_steps(RelaxationMethod method) {
  return method == RelaxationMethod::rkl || method == RelaxationMethod::multilevel;
}

struct RelaxationSettings {
  RelaxationLaw law = RelaxationLaw::paper;
  RelaxationMethod method = RelaxationMethod::passes;
  double talus_angle = 30.0;  ///< deg (angle of repose), above 0, below 90
  double tolerance = 1e-3;    ///< a cell rests if its slope exceeds tan(talus) by at most this fraction
  double step_tolerance =
      0.1;  ///< rkl, multilevel: error of a super-step, as a fraction of how far sand has moved
  /// Hz, relaxations during a stroke; 0 = none by time
  double rate = published_relaxation_rate;
  double way = 0.0;         ///< tool radii that the tool moves in sand between relaxations; 0 = none by way
  double way_at_rim = 0.0;  ///< tool radii: the same with R/5 of sand or more above its rim; 0 = as `way`
  double share = 0.0;       ///< c: 0 = the law's default (paper 1/2; isotropic 1/4, its limit; faces 1/4)
  std::int64_t max_passes = 1'000'000;  ///< per relaxation; of the bed itself, not of coarser ones
};

/// c of the settings, or the law's default.
double flow_share(const RelaxationSettings& settings);
/// The law of the settings on cells of this size [m].
TalusLaw talus_law(const RelaxationSettings& settings, double cell_size);

struct RelaxationOutcome {
  std::int64_t passes = 0;
  std::int64_t super_steps = 0;      ///< rkl; the passes are their stages
  std::int64_t rejected_stages = 0;  ///< rkl: stages taken back: heights left the range of the starting ones
  /// Maximum over the cells of slope/tan(talus) - 1 after the relaxation, at least 0.
  double residual = 0.0;
  /// m^3 that flowed from cell to cell, except through cells that pass on exactly as much as they take.
  double moved_volume = 0.0;
  double failed_volume = 0.0;      ///< m^3 of intact moist sand that came loose where cuts failed
  std::int64_t cells_visited = 0;  ///< cells that might have moved, summed over passes and the last check
  int tiles_active_max = 0;
  std::int64_t wake_ups = 0;  ///< how often a tile at rest became active
  bool converged = false;     ///< every cell rests, or the flow that is left is below rounding

  /// Adds the next relaxation: counts and volumes add up, residual and converged become the next one's.
  void add(const RelaxationOutcome& next);

  template <class State>
  void visit_state(State& state) {
    state.value("passes", passes);
    state.value("super_steps", super_steps);
    state.value("rejected_stages", rejected_stages);
    state.value("residual", residual);
    state.value("moved_volume", moved_volume);
    state.value("failed_volume", failed_volume);
    state.value("cells_visited", cells_visited);
    state.value("tiles_active_max", tiles_active_max);
    state.value("wake_ups", wake_ups);
    state.value("converged", converged);
  }
};

/// Returns the bed after the passes so far. Call it only if needed, since it copies all sand that moves.
using BedNow = std::function<const HeightField&()>;
/// Called after each pass, with the number of passes in this relaxation.
using PassWatcher = std::function<void(std::int64_t passes, const BedNow& bed_now)>;

/// Relaxes a bed to equilibrium by a law (rules/talus.h), again and again as it is disturbed. Passes are
/// Jacobi: all cells at once, from the old heights. A cell at rest (its slope is within the tolerance) gives
/// nothing. So what a patch of sand does depends on its neighbourhood only, not on whether sand elsewhere
/// still moves. (The stages of rkl have no tolerance, and its steps are as long as the whole of the moving
/// sand allows.) No sand crosses the border, or enters or leaves walls (HeightField::set_tool_walls).
class Relaxer {
 public:
  virtual ~Relaxer() = default;
  /// A copy that goes on with a copy of the bed; none: it cannot be copied.
  virtual std::unique_ptr<Relaxer> copy() const { return nullptr; }
  /// The bed must be as it was. Error: input, of a law that cannot tell its state, as those of plugins.
  virtual void visit_state(StateVisitor& /*state*/) {
    throw_input_error("the state of a plugin's law of relaxation is not known; it cannot be kept");
  }
  /// The time of the next relaxation [s], for sand that changes with it.
  virtual void set_time(double /*time*/) {}
  /// Takes over what a relaxer of the same kind remembers of the sand; bed: this one's, a copy of its.
  virtual void take_over(const Relaxer& /*other*/, const HeightField& /*bed*/) {}
  /// Stops at equilibrium, after max_passes (those that changed something, rejected ones included), or when
  /// interrupted(). Meanwhile the bed keeps its old heights, unless after_pass asks for it (or coarser beds
  /// help: multilevel).
  virtual RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass = {}) = 0;
};

/// The number of tiles that are allocated, or whose rule is steep enough to move. The first relaxation looks
/// at them, and allocates those beside them. With `plain`: the number of all tiles.
std::int64_t tiles_to_relax(const HeightField& bed, const RelaxationSettings& settings);
/// Memory that relaxing takes for each of them [bytes], the bed's own included. on_floor: sand lies on a
/// floor.
std::size_t bytes_per_relaxed_tile(const RelaxationSettings& settings, bool on_floor);

/// Makes the relaxer of one bed. It reads which cells are disturbed, and clears that
/// (HeightField::clear_disturbed), so a bed can have only one at a time.
std::unique_ptr<Relaxer> make_relaxer(const RelaxationSettings& settings, double cell_size);

}  // namespace sandstroke
