#pragma once

#include <memory>

#include "sand/relaxation.h"
#include "sand/standing_cuts.h"

namespace sandstroke {

inline constexpr double most_cohesion = 5000.0;  ///< Pa

/// How moist sand is bonded. Where regions give a cohesion of their own, that counts.
struct MoistureSettings {
  double cohesion = 0.0;        ///< Pa; 0: dry
  double friction_angle = 0.0;  ///< deg, of intact sand; 0: the talus angle
  SlipSurface surface = SlipSurface::spiral;
  bool heals = true;   ///< sand that has come to rest is intact again
  double dries = 0.0;  ///< Pa/s, that the cohesion loses

  bool operator==(const MoistureSettings&) const = default;
};

/// Makes the relaxer of a bed of moist sand. `flow` relaxes loose sand, which lies on the intact sand as on a
/// floor. Then cuts fail that are too high, and what was intact in them flows, too, until nothing fails. The
/// sand of the bed as it is now is intact. talus_slope (rise over run): of loose sand where the bed's ground
/// tells none. set_time() dries the sand.
struct StandingSand {
  CohesionFactor factor;
  Cohesion cohesion;
  double dries;  ///< m/s, that the cohesion over the weight per volume loses
  bool heals;
  double talus_slope;
};
std::unique_ptr<Relaxer> make_standing_relaxer(std::unique_ptr<Relaxer> flow, const HeightField& bed,
                                               const StandingSand& sand);

}  // namespace sandstroke
