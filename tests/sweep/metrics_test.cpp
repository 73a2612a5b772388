#include "sweep/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace sandstroke {
namespace {

/// Every number of its own, so that none can stand for another.
RunResult a_run() {
  RunResult run;
  run.wall_seconds = 0.25;
  run.simulated_seconds = 4.0;
  run.ticks = 4000;
  run.contact_ticks = 1000;
  run.relaxation.passes = 77;
  run.relaxation.residual = 0.011;
  run.device = {.saturated_ticks = 50,
                .max_force = 3.5,
                .mean_force = 1.25,
                .absorbed_energy = 0.75,
                .least_absorbed_energy = -0.0625,
                .least_passivity_margin = -2.5};
  run.displaced_volume = 1e-6;
  run.relaxation.failed_volume = 2e-7;
  run.load = LoadLedger{.spilled = 3e-7, .most = 4e-7};
  run.moved_volume = 3e-6;
  run.volume_drift = 1e-13;
  run.max_depth = 0.004;
  run.furrow = FurrowMeasures{.depth = 0.003, .width = 0.02, .rampart = 0.001};
  run.error = ErrorEstimate{
      .height_share = 0.07, .height_rms = 8e-5, .height_max = 9e-5, .force_rms = 0.11, .force_max = 0.13};
  return run;
}

const SlopeMeasures slopes{.mean = 12.0, .steepest = 29.0, .law_steepest = 28.0, .fraction_at_talus = 0.4};
const std::optional<FieldDifference> golden = FieldDifference{.max = 0.005, .rms = 0.0007, .volume = -2e-6};

std::map<std::string, double> values(const RunResult& run, const std::optional<FieldDifference>& against) {
  std::map<std::string, double> found;
  for (const Metric& metric : all_metrics()) found[metric.name] = metric.of({run, slopes, against});
  return found;
}

TEST(Metrics, EachIsItsOwnNumberOfTheRun) {
  const std::map<std::string, double> expected = {
      {"max_force", 3.5},          {"mean_force", 1.25},       {"work", 0.75},
      {"returned_energy", 0.0625}, {"passivity_margin", -2.5}, {"saturated_share", 0.05},
      {"max_depth", 0.004},        {"displaced_volume", 1e-6}, {"moved_volume", 3e-6},
      {"failed_volume", 2e-7},     {"carried_volume", 4e-7},   {"spilled_volume", 3e-7},
      {"volume_drift", 1e-13},     {"furrow_depth", 0.003},    {"furrow_width", 0.02},
      {"rampart_height", 0.001},   {"slope_mean", 12.0},       {"slope_max_geometric", 29.0},
      {"slope_max_law", 28.0},     {"slope_at_talus", 0.4},    {"passes", 77.0},
      {"residual", 0.011},         {"golden_max", 0.005},      {"golden_rms", 0.0007},
      {"golden_volume", -2e-6},    {"wall_seconds", 0.25},     {"real_time_factor", 16.0},
      {"error_share", 0.07},       {"error_height_rms", 8e-5}, {"error_height_max", 9e-5},
      {"error_force_rms", 0.11},   {"error_force_max", 0.13},
  };
  EXPECT_EQ(values(a_run(), golden), expected);
}

TEST(Metrics, AreDefined) {
  std::set<std::string> definitions;
  for (const Metric& metric : all_metrics()) {
    EXPECT_GT(metric.definition.size(), 20u) << metric.name;
    EXPECT_FALSE(metric.definition.ends_with('.')) << metric.name;
    definitions.insert(metric.definition);
  }
  EXPECT_EQ(definitions.size(), all_metrics().size());
}

TEST(Metrics, SayNothingOfWhatWasNotThere) {
  RunResult run = a_run();
  run.contact_ticks = run.ticks = 0;
  run.furrow.reset();
  run.error.reset();
  run.device.least_absorbed_energy = 0.0;
  for (const auto& [name, value] : values(run, std::nullopt)) {
    const bool needs_it = name == "mean_force" || name == "saturated_share" || name == "max_depth" ||
                          name == "real_time_factor" || name == "rampart_height" ||
                          name.starts_with("furrow_") || name.starts_with("golden_") ||
                          name.starts_with("error_");
    EXPECT_EQ(std::isnan(value), needs_it) << name;
  }
  EXPECT_EQ(values(run, std::nullopt)["returned_energy"], 0.0);
}

}  // namespace
}  // namespace sandstroke
