#include "fit/fitted_law.h"

#include "core/interrupt.h"
#include "fit/felt_ticks.h"
#include "fit/least_squares.h"

namespace sandstroke {
namespace {

/// None if it was interrupted.
std::optional<ForceFit> whole_fit(const FeltLaw& law, const std::vector<bool>& asked) {
  ForceFit fit = fit_force(law, asked);
  if (interrupted()) return std::nullopt;
  return fit;
}

/// The force of each tick follows from depth and velocity, which a run tells once and for all.
std::optional<ForceFit> fit_paper(const FeltStroke& felt, const std::vector<bool>& is_free) {
  const std::vector<FeltTick> ticks = felt_ticks(felt);
  if (interrupted()) return std::nullopt;
  return whole_fit(
      PaperLaw(ticks, felt.scene.force, felt.scene.device.max_force, 1.0 / felt.scene.device.servo_rate),
      is_free);
}

/// The force is not linear in the constants. The run is played again, with sands around the best values so
/// far, until these change by at most 1 %, but no more than five times in all.
std::optional<ForceFit> fit_contact(const FeltStroke& felt, const std::vector<bool>& is_free) {
  constexpr int most_turns = 5;  // a constant that the recording does not determine may never converge
  const SandStrength& sand = felt.scene.strength;
  const std::span<const ForceConstant> constants = fitted_law(felt.scene.force.law).constants;
  Eigen::VectorXd best = values_in(sand, constants);
  for (int turn = 1;; ++turn) {
    const ContactLaw near = felt_in(felt, {constants, sand, best, is_free});
    if (interrupted()) return std::nullopt;
    best = LeastSquares{near, near.recorded(), is_free}.best();
    if (turn == most_turns || near.grid().is_close_about(best)) return whole_fit(near, is_free);
  }
}

constexpr FittedLaw laws[] = {
    {"paper", paper_constants, "grows with the depth in the sand and, sideways, with the speed", fit_paper},
    {"rft", rft_constants,
     "grows with the depth of each part of the tool in the sand and is the same at any speed", fit_contact},
    {"archimedes", archimedes_constants, "points up and grows with the volume of the tool in the sand",
     fit_contact}};

}  // namespace

std::span<const FittedLaw> fitted_laws() { return laws; }

const FittedLaw& fitted_law(ForceLaw law) { return laws[static_cast<std::size_t>(law)]; }

}  // namespace sandstroke
