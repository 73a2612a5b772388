#include "validation/study/stroke_replay.h"

#include <algorithm>
#include <cmath>

#include "sand/cell_means.h"
#include "validation/study/error_checks.h"
#include "validation/study/surface_error.h"

namespace sandstroke {
namespace {

constexpr double sample_rate = 100.0;  // Hz, of the compared samples; every servo rate is a multiple

std::int64_t ticks_a_sample(const Scene& scene) {
  return std::llround(scene.device.servo_rate / sample_rate);
}

}  // namespace

Replay replay(const Scene& scene, const Stroke& stroke) {
  Kept force(force_of, ticks_a_sample(scene));
  Kept position(
      +[](const TickRecord& tick) { return tick.device_position; }, ticks_a_sample(scene));
  const Solution run = solve(scene, starting_bed(scene.bed), stroke, {&force, &position});
  return {run.result, run.surface.grid(), std::move(force.values), std::move(position.values)};
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

/// Misplaced sand, against a run on the same grid or a finer one. Both runs began flat.
SurfaceError surface_distance(const HeightGrid& heights, const Replay& truth) {
  const int factor = static_cast<int>(truth.heights.rows() / heights.rows());
  const HeightGrid exact = coarsened(HeightField(truth.heights, 1.0), factor).grid();
  return surface_error(heights, HeightGrid::Zero(exact.rows(), exact.cols()), exact);
}

}  // namespace

Score judge(const Replay& run, const Replay& truth) {
  Score score = score_of(run.result);
  const SurfaceError error = surface_distance(run.heights, truth);
  const double height = truth.heights.maxCoeff() - truth.heights.minCoeff();
  score.l1 = error.l1;
  score.rms_height = error.rms;
  score.rms_relative = error.rms / height;
  score.largest_height = error.largest;
  score.largest_relative = error.largest / height;
  score.force_error = rms_distance(run.force, truth.force) / largest(truth.force);
  score.position_error = rms_distance(run.position, truth.position);
  score.displaced_volume = run.result.displaced_volume;
  if (run.result.furrow) score.furrow_depth = run.result.furrow->depth;
  return score;
}

std::vector<ErrorCheck> check_errors(const std::string& label, const Scene& scene, const Stroke& stroke,
                                     const Replay& truth) {
  const auto every = static_cast<std::size_t>(ticks_a_sample(scene));
  const auto judge = [&](const HeightField& surface, const std::vector<Eigen::Vector3d>& force) {
    TrueError error;
    error.height_share = surface_distance(surface.grid(), truth).l1;
    double squares = 0.0, forces = 0.0;
    for (std::size_t i = 0; i < truth.force.size() && i * every < force.size(); ++i) {
      squares += (force[i * every] - truth.force[i]).squaredNorm();
      forces += force[i * every].squaredNorm() > 0.0;
    }
    error.force_rms = std::sqrt(squares / forces);
    return error;
  };
  return check_errors(label, scene, starting_bed(scene.bed), stroke, judge);
}

Contender stroke_contender(const std::string& series, const std::string& label, const Scene& scene,
                           int threads, double step, const Stroke& stroke,
                           const std::shared_ptr<const Replay>& truth) {
  return {series, label, settings_of(scene, threads), step, [=] {
            const Replay run = replay(scene, stroke);
            return Trial{run.result.wall_seconds, judge(run, *truth)};
          }};
}

}  // namespace sandstroke
