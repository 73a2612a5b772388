#include "sweep/metrics.h"

#include <algorithm>

namespace sandstroke {
namespace {

/// value, where the tool touched sand.
double in_contact(const PointOutcome& o, double value) {
  return o.run.contact_ticks > 0 ? value : PointResult::none;
}
double of_furrow(const PointOutcome& o, double FurrowMeasures::*value) {
  return o.run.furrow ? (*o.run.furrow).*value : PointResult::none;
}
double of_golden(const PointOutcome& o, double FieldDifference::*value) {
  return o.golden ? (*o.golden).*value : PointResult::none;
}

}  // namespace

const std::vector<Metric>& all_metrics() {
  using O = const PointOutcome&;
  static const std::vector<Metric> metrics = {
      {"max_force", "peak force", "N", [](O o) { return o.run.device.max_force; }},
      {"mean_force", "mean force in contact", "N",
       [](O o) { return in_contact(o, o.run.device.mean_force); }},
      {"work", "work done on the sand", "J", [](O o) { return o.run.device.absorbed_energy; }},
      {"returned_energy", "most energy that the sand returned", "J",
       [](O o) { return std::max(0.0, -o.run.device.least_absorbed_energy); }},
      {"passivity_margin", "least passivity margin", "N s/m",
       [](O o) { return o.run.device.least_passivity_margin; }},
      {"saturated_share", "share of contact at the device's limit", "",
       [](O o) {
         return in_contact(
             o, static_cast<double>(o.run.device.saturated_ticks) / static_cast<double>(o.run.contact_ticks));
       }},
      {"max_depth", "largest depth of the tip", "m", [](O o) { return in_contact(o, o.run.max_depth); }},
      {"displaced_volume", "sand displaced by the tool", "m^3", [](O o) { return o.run.displaced_volume; }},
      {"moved_volume", "sand moved, with what slipped", "m^3", [](O o) { return o.run.moved_volume; }},
      {"volume_drift", "volume drift per sand moved", "", [](O o) { return o.run.volume_drift; }},
      {"furrow_depth", "furrow depth", "m", [](O o) { return of_furrow(o, &FurrowMeasures::depth); }},
      {"furrow_width", "furrow width", "m", [](O o) { return of_furrow(o, &FurrowMeasures::width); }},
      {"rampart_height", "rampart height", "m", [](O o) { return of_furrow(o, &FurrowMeasures::rampart); }},
      {"slope_mean", "mean slope of changed sand", "deg", [](O o) { return o.slopes.mean; }, Metric::slopes},
      {"slope_max", "steepest slope of changed sand", "deg", [](O o) { return o.slopes.steepest; },
       Metric::slopes},
      {"slope_at_talus", "share of changed sand within 1 deg of the talus angle", "",
       [](O o) { return o.slopes.share_at_talus; }, Metric::slopes},
      {"passes", "relaxation passes", "", [](O o) { return static_cast<double>(o.run.relaxation.passes); }},
      {"residual", "residual slope above the talus angle", "", [](O o) { return o.run.relaxation.residual; }},
      {"golden_max", "largest difference from the golden surface", "m",
       [](O o) { return of_golden(o, &FieldDifference::max); }, Metric::golden},
      {"golden_rms", "RMS difference from the golden surface", "m",
       [](O o) { return of_golden(o, &FieldDifference::rms); }, Metric::golden},
      {"golden_volume", "sand more than in the golden surface", "m^3",
       [](O o) { return of_golden(o, &FieldDifference::volume); }, Metric::golden},
      {"wall_seconds", "run time of the simulation", "s", [](O o) { return o.run.wall_seconds; }, Metric::run,
       true},
      {"real_time_factor", "simulated time per run time", "",
       [](O o) { return o.run.ticks > 0 ? o.run.simulated_seconds / o.run.wall_seconds : PointResult::none; },
       Metric::run, true},
  };
  return metrics;
}

}  // namespace sandstroke
