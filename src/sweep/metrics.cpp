#include "sweep/metrics.h"

namespace sandstroke {

const std::vector<Metric>& all_metrics() {
  static const std::vector<Metric> metrics = {
      {"max_force", "peak force", "N"},
      {"mean_force", "mean force in contact", "N"},
      {"work", "work done on the sand", "J"},
      {"returned_energy", "most energy that the sand returned", "J"},
      {"passivity_margin", "least passivity margin", "N s/m"},
      {"saturated_share", "share of contact at the device's limit", ""},
      {"max_depth", "largest depth of the tip", "m"},
      {"displaced_volume", "sand displaced by the tool", "m^3"},
      {"moved_volume", "sand moved, with what slipped", "m^3"},
      {"volume_drift", "volume drift per sand moved", ""},
      {"furrow_depth", "furrow depth", "m"},
      {"furrow_width", "furrow width", "m"},
      {"rampart_height", "rampart height", "m"},
      {"slope_mean", "mean slope of changed sand", "deg"},
      {"slope_max", "steepest slope of changed sand", "deg"},
      {"slope_at_talus", "share of changed sand within 1 deg of the talus angle", ""},
      {"passes", "relaxation passes", ""},
      {"residual", "residual slope above the talus angle", ""},
      {"golden_max", "largest difference from the golden surface", "m", false, true},
      {"golden_rms", "RMS difference from the golden surface", "m", false, true},
      {"golden_volume", "sand more than in the golden surface", "m^3", false, true},
      {"wall_seconds", "run time of the simulation", "s", true},
      {"real_time_factor", "simulated time per run time", "", true},
  };
  return metrics;
}

}  // namespace sandstroke
