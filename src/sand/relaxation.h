#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "rules/talus.h"
#include "sand/height_field.h"

namespace sandstroke {

inline constexpr const char* relaxation_law_names[] = {"paper", "isotropic", "faces"};
/// passes: Jacobi passes of the law over the sand that can move. rkl: super time steps, which reach the rest
/// that small steps of the law reach in far fewer passes (relaxation_rkl.cpp). plain: talus_pass over all
/// cells, which is slow, and has the bits of `passes`; a law of your own begins there.
enum class RelaxationMethod { passes, rkl, plain };
inline constexpr const char* relaxation_method_names[] = {"passes", "rkl", "plain"};

struct RelaxationSettings {
  RelaxationLaw law = RelaxationLaw::paper;
  RelaxationMethod method = RelaxationMethod::passes;
  double talus_angle = 30.0;    ///< deg (angle of repose), above 0, below 90
  double tolerance = 1e-3;      ///< a cell whose slope exceeds tan(talus) by no more than this share rests
  double step_tolerance = 0.1;  ///< rkl: error of a super-step, as a share of how far sand has moved
  double rate = 60.0;       ///< Hz, relaxations during a stroke; 0 = none by time (paper: the visual loop)
  double way = 0.0;         ///< tool radii that it goes through sand between relaxations; 0 = none by way
  double way_at_rim = 0.0;  ///< tool radii: the same where sand stands R/5 above its rim; 0 = as `way`
  double share = 0.0;       ///< c: 0 = the law's own (paper 1/2, isotropic 1/4, which is also its limit)
  std::int64_t max_passes = 1'000'000;  ///< per relaxation
};

/// c of the settings, or the law's own.
double flow_share(const RelaxationSettings& settings);
/// The law of the settings on cells of this size [m].
TalusLaw talus_law(const RelaxationSettings& settings, double cell_size);

struct RelaxationOutcome {
  std::int64_t passes = 0;
  std::int64_t super_steps = 0;      ///< rkl; the passes are their stages
  std::int64_t rejected_stages = 0;  ///< rkl: taken back, since heights left the range of the starting ones
  /// Of the field left behind: max over cells of slope/tan(talus) - 1, at least 0.
  double residual = 0.0;
  /// m^3, what flowed from cell to cell; not through cells that pass on exactly as much as they take.
  double moved_volume = 0.0;
  std::int64_t cells_visited = 0;  ///< that might have moved, summed over passes, the last look included
  int tiles_active_max = 0;
  std::int64_t wake_ups = 0;  ///< of tiles at rest
  bool converged = false;     ///< every cell rests, or what still flows is below rounding

  /// Goes on with what came next: counts and volumes add up, residual and converged are the next one's.
  void add(const RelaxationOutcome& next);
};

/// The bed as the passes so far have made it. Whoever does not look at it should not ask, which costs a copy
/// of what moves.
using BedNow = std::function<const HeightField&()>;
/// Told after each pass: how many there were in this relaxation.
using PassWatcher = std::function<void(std::int64_t passes, const BedNow& bed_now)>;

/// Relaxes a bed to equilibrium by a law (rules/talus.h), again and again as it is disturbed. Passes are
/// Jacobi: all cells at once, from the old heights. A cell at rest (its slope is within the tolerance) gives
/// nothing. So what a patch of sand does depends on its neighbourhood only, not on whether sand elsewhere
/// still moves. (The stages of rkl have no tolerance, and its steps are as long as the whole of the moving
/// sand allows.) Nothing crosses the border, nor gets into or out of walls (HeightField::hold).
class Relaxer {
 public:
  virtual ~Relaxer() = default;
  /// Stops at equilibrium, after max_passes (those that changed something, rejected ones included), or when
  /// interrupted(). Meanwhile the bed has its old heights, but for who asks after a pass.
  virtual RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass = {}) = 0;
};

/// How many tiles are allocated, or steep enough to move by their rule: the first relaxation wakes them, and
/// allocates those beside them.
std::int64_t tiles_to_relax(const HeightField& bed, const RelaxationSettings& settings);
/// Memory that relaxing takes for each of them [bytes], the bed's own included.
std::size_t bytes_per_relaxed_tile(const RelaxationSettings& settings);

/// The relaxer of one bed. It takes up which cells are disturbed, and clears that
/// (HeightField::clear_disturbed), so a bed can have only one at a time.
std::unique_ptr<Relaxer> make_relaxer(const RelaxationSettings& settings, double cell_size);

}  // namespace sandstroke
