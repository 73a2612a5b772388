#include "sweep/point_runner.h"

#include <algorithm>
#include <map>

#include "compare/field_difference.h"
#include "core/error.h"
#include "sim/furrow.h"
#include "sim/simulation.h"
#include "sweep/slopes.h"

namespace sandstroke {
namespace {

/// One scene's device on sand that a simulation moves.
struct Feeler {
  const Scene* scene;
  std::optional<DeviceSide> device;  // from the first tick on
  std::string failure;               // why it went no further

  void on_tick(TickRecord record) {
    if (!failure.empty()) return;
    if (!device) device.emplace(scene->force, scene->device, record.hand);
    try {
      device->feel(record);
      device->advance(record);
    } catch (const Error& unstable) {
      failure = unstable.what();
    }
  }
};

/// Follows the tip, and lets each feeler feel.
class Followers : public SimulationObserver {
 public:
  Followers(const Scene& scene, std::vector<Feeler>& feelers) : path_(scene), feelers_(feelers) {}

  void on_tick(const TickRecord& record) override {
    for (Feeler& feeler : feelers_) feeler.on_tick(record);
    path_.add(record);
  }
  const TipPath& path() const { return path_.path(); }

 private:
  TipPathGatherer path_;
  std::vector<Feeler>& feelers_;
};

PointVerdict verdict_of(const RunResult& result, const Scene& scene) {
  if (!result.converged) return PointVerdict::not_at_rest;
  const bool active =
      scene.device.model == DeviceModel::dynamic && loop_returned_energy(result, scene.device);
  return active ? PointVerdict::active : PointVerdict::at_rest;
}

/// What a run came to, by the metrics' names.
class Measures {
 public:
  void add_forces(const RunResult& r) {
    const bool contact = r.contact_ticks > 0;
    const auto ticks = static_cast<double>(r.contact_ticks);
    set("max_force", r.max_force);
    set("mean_force", contact ? r.mean_force : PointResult::none);
    set("work", r.absorbed_energy);
    set("returned_energy", std::max(0.0, -r.least_absorbed_energy));
    set("passivity_margin", r.least_passivity_margin);
    set("saturated_share", contact ? static_cast<double>(r.saturated_ticks) / ticks : PointResult::none);
  }
  void add_sand(const RunResult& r) {
    set("max_depth", r.contact_ticks > 0 ? r.max_depth : PointResult::none);
    set("displaced_volume", r.displaced_volume);
    set("moved_volume", r.moved_volume);
    set("volume_drift", r.volume_drift);
    set("passes", static_cast<double>(r.passes));
    set("residual", r.residual);
    set("wall_seconds", r.wall_seconds);
    set("real_time_factor", r.ticks > 0 ? r.simulated_seconds / r.wall_seconds : PointResult::none);
  }
  void set(const std::string& name, double value) { values_[name] = value; }
  std::vector<double> of(const std::vector<Metric>& metrics) const {
    std::vector<double> values;
    for (const Metric& metric : metrics) {
      const auto found = values_.find(metric.name);
      values.push_back(found == values_.end() ? PointResult::none : found->second);
    }
    return values;
  }

 private:
  std::map<std::string, double> values_;
};

bool wants(const std::vector<Metric>& metrics, std::initializer_list<const char*> names) {
  return std::any_of(metrics.begin(), metrics.end(), [&](const Metric& metric) {
    return std::find(names.begin(), names.end(), metric.name) != names.end();
  });
}

/// Shapes of the surface, as far as they are asked for.
void add_shapes(Measures& measures, const std::vector<Metric>& metrics, const Scene& scene,
                const HeightField& initial, const HeightField& final, const TipPath& path,
                const HeightField* golden) {
  if (wants(metrics, {"furrow_depth", "furrow_width", "rampart_height"})) {
    const FurrowMeasures furrow = measure_furrow(initial, final, path, scene.tool.radius);
    measures.set("furrow_depth", furrow.depth);
    measures.set("furrow_width", furrow.width);
    measures.set("rampart_height", furrow.rampart);
  }
  if (wants(metrics, {"slope_mean", "slope_max", "slope_at_talus"})) {
    const SlopeMeasures slopes = measure_slopes(initial, final, scene.relaxation.talus_angle);
    measures.set("slope_mean", slopes.mean);
    measures.set("slope_max", slopes.steepest);
    measures.set("slope_at_talus", slopes.share_at_talus);
  }
  const bool fits = golden && golden->rows() == final.rows() && golden->cols() == final.cols();
  if (fits && wants(metrics, {"golden_max", "golden_rms", "golden_volume"})) {
    const FieldDifference difference = field_difference(*golden, final);
    measures.set("golden_max", difference.max);
    measures.set("golden_rms", difference.rms);
    measures.set("golden_volume", difference.volume);
  }
}

}  // namespace

PointResult failed_point(PointVerdict verdict, const std::string& reason, std::size_t metrics) {
  return {verdict, reason, std::vector<double>(metrics, PointResult::none)};
}

std::optional<SharedRunResult> run_shared(const std::vector<Scene>& scenes, const HeightField& bed,
                                          const Stroke* stroke, const std::vector<Metric>& metrics,
                                          const HeightField* golden) {
  Scene scene = scenes.front();
  std::vector<Feeler> feelers;
  if (scene.device.model == DeviceModel::kinematic) {
    for (const Scene& felt : scenes) {
      feelers.push_back({&felt, {}, {}});
      if (!stroke) feelers.back().device.emplace(felt.force, felt.device, Hand{});  // there are no ticks
    }
    scene.force.k_s = 0.0;  // the sand's own run feels nothing, and so cannot fail for a force
  }
  Followers followers(scene, feelers);
  try {
    Simulation simulation(scene, bed, stroke ? std::optional(*stroke) : std::nullopt);
    const RunResult sand = simulation.run(followers);
    if (sand.interrupted) return std::nullopt;
    Measures shared;
    shared.add_sand(sand);
    add_shapes(shared, metrics, scene, bed, simulation.bed(), followers.path(), golden);

    SharedRunResult result{{}, simulation.bed()};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      RunResult felt = sand;
      if (i < feelers.size()) {
        if (!feelers[i].failure.empty()) {
          result.points.push_back(failed_point(PointVerdict::unstable, feelers[i].failure, metrics.size()));
          continue;
        }
        feelers[i].device->report(felt);
      }
      Measures measures = shared;
      measures.add_forces(felt);
      result.points.push_back({verdict_of(felt, scenes[i]), "", measures.of(metrics)});
    }
    return result;
  } catch (const Error& error) {
    if (is_of_the_machine(error)) throw;
    const PointVerdict verdict =
        error.kind() == ErrorKind::unstable ? PointVerdict::unstable : PointVerdict::refused;
    const PointResult point = failed_point(verdict, error.what(), metrics.size());
    return SharedRunResult{std::vector<PointResult>(scenes.size(), point), bed};
  }
}

}  // namespace sandstroke
