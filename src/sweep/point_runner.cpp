#include "sweep/point_runner.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/interrupt.h"
#include "measure/solution.h"

namespace sandstroke {
namespace {

/// One scene's device, which feels the sand of a simulation and does not move it.
class Feeler : public SimulationObserver {
 public:
  Feeler(const Scene& scene, bool keeps_force) : device_(scene), keeps_force_(keeps_force) {}

  void on_tick(const TickRecord& sand) override {
    if (!failure_.empty()) return;
    if (!std::exchange(started_, true)) device_.start(sand.hand);
    TickRecord felt = sand;
    try {
      device_.feel(felt);
      if (keeps_force_) force_.on_tick(felt);
      device_.advance(felt);
    } catch (const Error& unstable) {
      failure_ = unstable.what();
    }
  }
  void visit_state(StateVisitor& state) override {
    device_.visit_state(state);
    force_.visit_state(state);
    state.value("feeler.started", started_);
    state.value("feeler.failure", failure_);
  }
  /// Why the device stopped. Empty: it went to the end.
  const std::string& failure() const { return failure_; }
  DeviceResult result() const { return device_.result(); }
  const Kept<Eigen::Vector3d>& force() const { return force_; }

 private:
  DeviceSide device_;
  bool keeps_force_;
  Kept<Eigen::Vector3d> force_{force_of};
  bool started_ = false;
  std::string failure_;
};

PointVerdict verdict_of(const RunResult& result, const Scene& scene) {
  if (!result.relaxation.converged) return PointVerdict::not_at_rest;
  const bool active =
      scene.device.model == DeviceModel::dynamic && loop_returned_energy(result.device, scene.device);
  return active ? PointVerdict::active : PointVerdict::at_rest;
}

/// Estimates a run's error. None if the second solution is unstable: the run itself stays valid.
std::optional<ErrorEstimate> error_of(const Scene& scene, const HeightField& bed,
                                      const std::optional<Stroke>& stroke, const Solution& run,
                                      const Kept<Eigen::Vector3d>& force, SecondSolution second) {
  try {
    return estimate_error(scene, bed, stroke, run, force, second);
  } catch (const Error& failure) {
    if (failure.kind() != ErrorKind::unstable) throw;
    return std::nullopt;
  }
}

bool wants(const std::vector<Metric>& metrics, Metric::Needs what) {
  return std::any_of(metrics.begin(), metrics.end(),
                     [&](const Metric& metric) { return metric.needs == what; });
}

}  // namespace

PointResult failed_point(PointVerdict verdict, const std::string& reason, std::size_t metrics) {
  return {verdict, reason, std::vector<double>(metrics, PointResult::none)};
}

std::optional<SharedRunResult> run_shared(const std::vector<Scene>& scenes, const HeightField& bed,
                                          const Stroke* stroke, const std::vector<Metric>& metrics,
                                          const HeightField* golden, std::optional<SecondSolution> second,
                                          const Checkpoints& checkpoints) {
  Scene scene = scenes.front();
  std::vector<Feeler> feelers;
  if (scene.device.model == DeviceModel::kinematic) {
    for (const Scene& felt : scenes) feelers.emplace_back(felt, second.has_value());
    scene.force.k_s = 0.0;  // the shared run feels no force, so no force can end it
    for (SandRegion& region : scene.ground.regions)
      if (region.k_s) region.k_s = 0.0;
  }
  Observers observers;
  for (Feeler& feeler : feelers) observers.push_back(&feeler);
  Kept own_force(force_of);
  if (second && feelers.empty()) observers.push_back(&own_force);
  const std::optional<Stroke> played = stroke ? std::optional(*stroke) : std::nullopt;
  try {
    auto [surface, sand] = solve(scene, bed, played, observers, checkpoints);
    if (sand.interrupted) return std::nullopt;
    SlopeMeasures slopes;
    if (wants(metrics, Metric::slopes)) slopes = measure_slopes(bed, surface, scene.relaxation);
    std::optional<FieldDifference> difference;
    if (golden && golden->rows() == surface.rows() && golden->cols() == surface.cols() &&
        wants(metrics, Metric::golden))
      difference = field_difference(*golden, surface);

    SharedRunResult result{{}, std::move(surface)};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      RunResult run = sand;
      if (i < feelers.size()) {
        if (!feelers[i].failure().empty()) {
          result.points.push_back(failed_point(PointVerdict::unstable, feelers[i].failure(), metrics.size()));
          continue;
        }
        run.device = feelers[i].result();
      }
      if (second) {
        const Kept<Eigen::Vector3d>& force = feelers.empty() ? own_force : feelers[i].force();
        run.error = error_of(scenes[i], bed, played, {result.surface, run}, force, *second);
        if (interrupted()) return std::nullopt;
      }
      PointResult& point = result.points.emplace_back(PointResult{verdict_of(run, scenes[i]), "", {}});
      for (const Metric& metric : metrics) point.metrics.push_back(metric.of({run, slopes, difference}));
    }
    return result;
  } catch (const Error& error) {
    if (is_of_the_machine(error)) throw;
    if (!checkpoints.from.empty() && error.kind() == ErrorKind::input) {
      spdlog::warn("{}; the point begins at its start", error.what());
      return run_shared(scenes, bed, stroke, metrics, golden, second,
                        {"", checkpoints.due, checkpoints.keep});
    }
    const PointVerdict verdict =
        error.kind() == ErrorKind::unstable ? PointVerdict::unstable : PointVerdict::refused;
    const PointResult point = failed_point(verdict, error.what(), metrics.size());
    return SharedRunResult{std::vector<PointResult>(scenes.size(), point), bed};
  }
}

}  // namespace sandstroke
