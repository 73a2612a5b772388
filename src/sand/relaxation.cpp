#include "sand/relaxation.h"

#include <cmath>
#include <numbers>

#include "sand/talus_law.h"

namespace sandstroke {

double flow_share(const RelaxationSettings& settings) {
  if (settings.share > 0.0) return settings.share;
  return settings.law == RelaxationLaw::paper ? 0.5 : 0.25;
}

TalusLaw::TalusLaw(const RelaxationSettings& settings, double cell_size)
    : law(settings.law),
      share(flow_share(settings)),
      axis_drop(std::tan(settings.talus_angle * std::numbers::pi / 180.0) * cell_size),
      diagonal_drop(axis_drop * std::numbers::sqrt2),
      axis_limit(axis_drop * (1.0 + settings.tolerance)),
      diagonal_limit(diagonal_drop * (1.0 + settings.tolerance)) {}

std::unique_ptr<Relaxer> make_relaxer(const RelaxationSettings& settings, double cell_size) {
  if (settings.engine == RelaxationEngine::reference) return make_reference_relaxer(settings, cell_size);
  return settings.method == RelaxationMethod::rkl ? make_rkl_relaxer(settings, cell_size)
                                                  : make_tile_relaxer(settings, cell_size);
}

}  // namespace sandstroke
