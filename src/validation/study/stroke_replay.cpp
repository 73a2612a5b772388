#include "validation/study/stroke_replay.h"

#include <algorithm>
#include <cmath>

#include "validation/study/error_checks.h"
#include "validation/study/surface_error.h"

namespace sandstroke {
namespace {

constexpr double sample_rate = 100.0;  // Hz, of what is compared; every servo rate is a multiple

class Sampling : public SimulationObserver {
 public:
  Sampling(Replay& replay, const Scene& scene)
      : replay_(replay), path_(scene), every_(std::llround(scene.device.servo_rate / sample_rate)) {}
  const TipPath& path() const { return path_.path(); }
  void on_tick(const TickRecord& tick) override {
    path_.add(tick);
    if (ticks_++ % every_ != 0) return;
    replay_.force.push_back(tick.device_force);
    replay_.position.push_back(tick.device_position);
  }

 private:
  Replay& replay_;
  TipPathGatherer path_;
  std::int64_t every_, ticks_ = 0;
};

}  // namespace

Replay replay(const Scene& scene, const Stroke& stroke) {
  const HeightField start =
      make_surface(scene.bed.surface, scene.bed.rows, scene.bed.cols, scene.bed.cell_size());
  Simulation simulation(scene, start, stroke);
  Replay run;
  Sampling sampling(run, scene);
  run.result = simulation.run(sampling);
  run.result.furrow = measure_furrow(start, simulation.bed(), sampling.path(), scene.tool.radius);
  run.heights = simulation.bed().grid();
  return run;
}

namespace {

double rms_distance(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  const std::size_t n = std::min(a.size(), b.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(n));
}

double largest(const std::vector<Eigen::Vector3d>& values) {
  double norm = 0.0;
  for (const Eigen::Vector3d& value : values) norm = std::max(norm, value.norm());
  return norm;
}

/// Misplaced sand against a run on as fine a grid or a finer one, that began flat.
SurfaceError surface_distance(const HeightGrid& heights, const Replay& truth) {
  const HeightGrid exact = coarsened(truth.heights, static_cast<int>(truth.heights.rows() / heights.rows()));
  return surface_error(heights, HeightGrid::Zero(exact.rows(), exact.cols()), exact);
}

}  // namespace

Score judge(const Replay& run, const Replay& truth) {
  Score score;
  const SurfaceError error = surface_distance(run.heights, truth);
  const double height = truth.heights.maxCoeff() - truth.heights.minCoeff();
  score.passes = static_cast<double>(run.result.passes);
  score.cells_visited = static_cast<double>(run.result.cells_visited);
  score.l1 = error.l1;
  score.rms_height = error.rms, score.rms_relative = error.rms / height;
  score.largest_height = error.largest, score.largest_relative = error.largest / height;
  score.force_error = rms_distance(run.force, truth.force) / largest(truth.force);
  score.position_error = rms_distance(run.position, truth.position);
  score.volume_drift = run.result.volume_drift;
  score.displaced_volume = run.result.displaced_volume;
  score.furrow_depth = run.result.furrow->depth;
  score.converged = run.result.converged;
  return score;
}

std::vector<ErrorCheck> check_errors(const std::string& label, const Scene& scene, const Stroke& stroke,
                                     const Replay& truth) {
  const auto every = static_cast<std::size_t>(std::llround(scene.device.servo_rate / sample_rate));
  const auto judge = [&](const Solution& run) {
    TrueError error;
    error.height_share = surface_distance(run.surface.grid(), truth).l1;
    double squares = 0.0, forces = 0.0;
    for (std::size_t i = 0; i < truth.force.size() && i * every < run.force.size(); ++i) {
      squares += (run.force[i * every] - truth.force[i]).squaredNorm();
      forces += run.force[i * every].squaredNorm() > 0.0;
    }
    error.force_rms = std::sqrt(squares / forces);
    return error;
  };
  return check_errors(label, scene, HeightField(scene.bed.rows, scene.bed.cols, scene.bed.cell_size()),
                      stroke, judge);
}

Contender stroke_contender(const std::string& series, const std::string& label, const Scene& scene,
                           int threads, double step, const Stroke& stroke,
                           const std::shared_ptr<const Replay>& truth) {
  RunSettings settings = settings_of(
      scene.relaxation, BedGeometry(scene.bed.rows, scene.bed.cols, scene.bed.cell_size()), threads);
  settings.servo_rate = scene.device.servo_rate;
  settings.relaxation_rate = scene.relaxation.rate;
  return {series, label, settings, step, [=] {
            const Replay run = replay(scene, stroke);
            return Trial{run.result.wall_seconds, judge(run, *truth)};
          }};
}

}  // namespace sandstroke
