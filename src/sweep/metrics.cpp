#include "sweep/metrics.h"

#include <algorithm>

namespace sandstroke {
namespace {

/// Returns `value` if the tool touched sand, else none.
double in_contact(const PointOutcome& o, double value) {
  return o.run.contact_ticks > 0 ? value : PointResult::none;
}
double of_furrow(const PointOutcome& o, double FurrowMeasures::*value) {
  return o.run.furrow ? (*o.run.furrow).*value : PointResult::none;
}
double of_golden(const PointOutcome& o, double FieldDifference::*value) {
  return o.golden ? (*o.golden).*value : PointResult::none;
}
double of_error(const PointOutcome& o, double ErrorEstimate::*value) {
  return o.run.error ? (*o.run.error).*value : PointResult::none;
}

using O = const PointOutcome&;
const std::vector<Metric> metric_list = {
    {"max_force", "peak force", "N",
     "largest |F| of all ticks; F is the force on the device as it acts: late, and cut at the maximum",
     [](O o) { return o.run.device.max_force; }},
    {"mean_force", "mean force in contact", "N", "mean of |F| over the ticks in contact (depth > 0)",
     [](O o) { return in_contact(o, o.run.device.mean_force); }},
    {"work", "work done on the sand", "J",
     "-sum of F . dx over all ticks but those in gaps of the stroke; dx is the way of the device in a tick. "
     "If the tool is below the sand after a gap, the work of a plunge to that depth is added",
     [](O o) { return o.run.device.absorbed_energy; }},
    {"returned_energy", "most energy that the sand returned", "J",
     "max(0, -w); w is the least value that the work had at any time",
     [](O o) { return std::max(0.0, -o.run.device.least_absorbed_energy); }},
    {"passivity_margin", "least passivity margin", "N s/m",
     "least b + b_h - (K (T/2 + delay) + |B|) of the ticks in contact; b and b_h damp device and hand, K "
     "and B are stiffness and drag of the sand, T is the tick. Where it is above 0, the loop cannot create "
     "energy",
     [](O o) { return o.run.device.least_passivity_margin; }},
    {"saturated_share", "fraction of contact at the device's limit", "",
     "ticks in which the device's maximum cut the force / ticks in contact",
     [](O o) {
       return in_contact(
           o, static_cast<double>(o.run.device.saturated_ticks) / static_cast<double>(o.run.contact_ticks));
     }},
    {"max_depth", "largest depth of the tip", "m",
     "largest depth of the tip below the mean height of the sand around it, of the ticks in contact",
     [](O o) { return in_contact(o, o.run.max_depth); }},
    {"displaced_volume", "sand displaced by the tool", "m^3",
     "sum over all ticks of the sand that the tool displaced", [](O o) { return o.run.displaced_volume; }},
    {"moved_volume", "sand moved, including relaxation", "m^3",
     "displaced_volume + sand that flowed from cell to cell in relaxation",
     [](O o) { return o.run.moved_volume; }},
    {"failed_volume", "moist sand that came loose where cuts failed", "m^3",
     "intact sand that cuts took along when they failed; 0: every cut stands",
     [](O o) { return o.run.relaxation.failed_volume; }},
    {"carried_volume", "most sand on the tool", "m^3",
     "the most sand that lay on the tool at any time; 0: it carries none",
     [](O o) { return o.run.load ? o.run.load->most : 0.0; }},
    {"spilled_volume", "sand spilled by the tool", "m^3", "sand that ran over the rim of the tool",
     [](O o) { return o.run.load ? o.run.load->spilled : 0.0; }},
    {"volume_drift", "volume drift per sand moved", "",
     "|volume at the end - volume at the start| / moved_volume; 0 if nothing moved",
     [](O o) { return o.run.volume_drift; }},
    {"furrow_depth", "furrow depth", "m",
     "depth of the lowest point within a tool radius of the path, below the starting surface; median over "
     "cross-sections",
     [](O o) { return of_furrow(o, &FurrowMeasures::depth); }},
    {"furrow_width", "furrow width", "m",
     "distance between the points left and right of the lowest one where the change of height is 0; median "
     "over cross-sections",
     [](O o) { return of_furrow(o, &FurrowMeasures::width); }},
    {"rampart_height", "rampart height", "m",
     "height of the first raised sand beside the furrow, on its higher side, above the starting surface; "
     "median over cross-sections",
     [](O o) { return of_furrow(o, &FurrowMeasures::rampart); }},
    {"slope_mean", "mean slope of changed sand, by geometry", "deg",
     "mean of the geometric slope over the cells that changed. It is the angle of the steepest way down "
     "over the 8 triangles that a cell makes with its neighbours (Tarboton 1997)",
     [](O o) { return o.slopes.mean; }, Metric::slopes},
    {"slope_max_geometric", "steepest slope of changed sand, by geometry", "deg",
     "largest geometric slope (slope_mean) of the cells that changed. The law 'paper' looks in 8 "
     "directions only, so sand that rests by it may be as steep as atan(1.0824 tan(talus angle))",
     [](O o) { return o.slopes.steepest; }, Metric::slopes},
    {"slope_max_law", "steepest slope of changed sand, as the law measures it", "deg",
     "largest slope of the cells that changed as relaxation.law measures it. paper: drop to one of 8 "
     "neighbours / its distance. isotropic: sqrt(gx^2 + gy^2), gx = max(0, h - west, h - east)/dx. "
     "tan(slope_max_law) <= tan(talus angle) (1 + residual)",
     [](O o) { return o.slopes.law_steepest; }, Metric::slopes},
    {"slope_at_talus", "fraction of changed sand within 1 deg of the talus angle", "",
     "cells that changed and whose geometric slope (slope_mean) is within 1 deg of relaxation.talus_angle "
     "/ cells that changed",
     [](O o) { return o.slopes.fraction_at_talus; }, Metric::slopes},
    {"passes", "relaxation passes", "",
     "passes of all relaxations; with relaxation.method rkl, stages of super time steps",
     [](O o) { return static_cast<double>(o.run.relaxation.passes); }},
    {"residual", "residual slope above the talus angle", "",
     "max(0, s / tan(talus angle) - 1) after the last relaxation; s is the largest slope of all cells as "
     "relaxation.law measures it (slope_max_law)",
     [](O o) { return o.run.relaxation.residual; }},
    {"golden_max", "largest difference from the golden surface", "m", "largest |h - h_golden| of all cells",
     [](O o) { return of_golden(o, &FieldDifference::max); }, Metric::golden},
    {"golden_rms", "RMS difference from the golden surface", "m",
     "sqrt(mean of (h - h_golden)^2) over all cells", [](O o) { return of_golden(o, &FieldDifference::rms); },
     Metric::golden},
    {"golden_volume", "volume minus that of the golden surface", "m^3",
     "sum (h - h_golden) dx^2 over all cells; dx is the cell size",
     [](O o) { return of_golden(o, &FieldDifference::volume); }, Metric::golden},
    {"error_share", "estimated error: misplaced sand", "",
     "sum |e| / sum |h - h_start| over all cells; e is Richardson's estimate of a height's error: the "
     "distance from a second solution with steps twice or half as large, times 1 or 2",
     [](O o) { return of_error(o, &ErrorEstimate::height_share); }, Metric::error},
    {"error_height_rms", "estimated error of heights, RMS", "m",
     "sqrt(sum of e^2 / number of cells that changed); e as in error_share",
     [](O o) { return of_error(o, &ErrorEstimate::height_rms); }, Metric::error},
    {"error_height_max", "estimated error of heights, largest", "m",
     "largest |e| of all cells; e as in error_share",
     [](O o) { return of_error(o, &ErrorEstimate::height_max); }, Metric::error},
    {"error_force_rms", "estimated error of the force, RMS", "N",
     "as error_height_rms, of the force on the device, over the ticks with a force",
     [](O o) { return of_error(o, &ErrorEstimate::force_rms); }, Metric::error},
    {"error_force_max", "estimated error of the force, largest", "N",
     "as error_height_max, of the force on the device, over all ticks",
     [](O o) { return of_error(o, &ErrorEstimate::force_max); }, Metric::error},
    {"wall_seconds", "run time of the simulation", "s",
     "time that the run took, without starting and writing files. Points that share a run have the same",
     [](O o) { return o.run.wall_seconds; }, Metric::run, true},
    {"real_time_factor", "simulated time per run time", "", "simulated time / wall_seconds",
     [](O o) { return o.run.ticks > 0 ? o.run.simulated_seconds / o.run.wall_seconds : PointResult::none; },
     Metric::run, true},
};

}  // namespace

const std::vector<Metric>& all_metrics() { return metric_list; }

std::vector<KeySection> metric_keys() {
  KeySection section{
      "", "metrics of each point of a sweep (sweep.metrics of a plan): name, unit, definition", {}};
  for (const Metric& metric : all_metrics())
    section.keys.push_back({metric.name, "", metric.unit.empty() ? "1" : metric.unit, "",
                            metric.title + ": " + metric.definition});
  return {section};
}

}  // namespace sandstroke
