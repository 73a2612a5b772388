// Strokes whose truth has to be computed: the same run, finer.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "haptics/stroke_script.h"
#include "sim/simulation.h"
#include "study/error_checks.h"
#include "study/problem.h"
#include "study/surface_error.h"

namespace sandstroke {
namespace {

constexpr double sample_rate = 100.0;  // Hz, of what is compared; every servo rate is a multiple

/// What one run leaves behind.
struct Replay {
  RunResult result;
  HeightGrid heights;
  std::vector<Eigen::Vector3d> force, position;  // of the device, at sample_rate
};

class Sampling : public SimulationObserver {
 public:
  Sampling(Replay& replay, double servo_rate)
      : replay_(replay), every_(std::llround(servo_rate / sample_rate)) {}
  void on_tick(const TickRecord& tick) override {
    if (ticks_++ % every_ != 0) return;
    replay_.force.push_back(tick.device_force);
    replay_.position.push_back(tick.device_position);
  }

 private:
  Replay& replay_;
  std::int64_t every_, ticks_ = 0;
};

Replay replay(const Scene& scene, const Stroke& stroke) {
  Simulation simulation(
      scene, make_surface(scene.bed.surface, scene.bed.rows, scene.bed.cols, scene.bed.cell_size()), stroke);
  Replay run;
  Sampling sampling(run, scene.device.servo_rate);
  run.result = simulation.run(sampling);
  run.heights = simulation.bed().grid();
  return run;
}

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

/// Against a run on as fine a grid or a finer one, that began flat.
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
  score.converged = run.result.converged;
  return score;
}

/// What a run of the scene says of its error, beside its distance to the truth.
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

}  // namespace

Problem dynamic_problem(const ProblemOptions& options) {
  Problem problem{"dynamic",
                  "Dynamic device against a continuous loop",
                  "A hand plunges 8 mm and moves on at 0.1 m/s through a device of 0.25 kg; the truth is the "
                  "same loop at a servo rate that is all but continuous.",
                  "force_error",
                  "force, rms error of the largest",
                  "",
                  {}};
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 100;
  scene.device = ideal_device();
  scene.relaxation.rate = 0.0;  // sand that slips between ticks is another matter
  Stroke stroke;
  stroke.gap_threshold = 1.0;
  stroke.time = {0.0, 0.2, 0.6};
  stroke.position = {{-0.02, 0.0, 0.002}, {-0.02, 0.0, -0.008}, {0.02, 0.0, -0.008}};

  const double finest = options.quick ? 200e3 : 1e6;  // Hz
  const auto at_rate = [&](double rate) {
    Scene one = scene;
    one.device.servo_rate = rate;
    return one;
  };
  const auto truth = std::make_shared<const Replay>(replay(at_rate(finest), stroke));
  problem.converged_to = judge(replay(at_rate(0.5 * finest), stroke), *truth).force_error;
  for (const double rate : {100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0, 10e3, 20e3, 50e3})
    problem.contenders.push_back(stroke_contender("force held for a tick",
                                                  fmt::format("servo rate {} Hz", rate), at_rate(rate),
                                                  options.threads, 1.0 / rate, stroke, truth));
  problem.check_errors = [=] {  // cells count here, too: the level under the tool is a mean of theirs
    Scene eighth = scene;
    for (int halvings = 0; halvings < 3; ++halvings) eighth = second_scene(eighth, SecondSolution::finer);
    return check_errors("1000 Hz, 5 cells per radius", scene, stroke, replay(eighth, stroke));
  };
  return problem;
}

namespace {

/// A curved stroke with the paper's tool, 4 mm deep at 0.25 m/s.
Stroke s_curve(bool quick) {
  StrokeScript script;
  script.start = {-0.08, -0.02};
  script.clearance = 0.005;
  script.segments.push_back(
      {ScriptSpline{{{-0.08, -0.02}, {-0.03, 0.06}, {0.0, 0.0}, {0.03, -0.06}, {0.08, 0.02}}},
       {PressProfile::Kind::depth, {0.004}},
       0.25});
  if (quick) script.segments[0].shape = ScriptSpline{{{-0.08, -0.02}, {-0.03, 0.03}, {0.02, -0.02}}};
  return trace_script(script, {});
}

/// The default cell size, tolerance and relaxation rate, each divided as told (the rate multiplied), with
/// ticks enough for the finest rate.
Scene refined(ModelPreset preset, int cells_by, int tolerance_by, int period_by) {
  Scene scene;
  scene.preset = preset;
  apply_model_preset(scene);
  scene.bed.width = scene.bed.depth = 0.24;
  scene.bed.cols = scene.bed.rows = 120 * cells_by;
  scene.relaxation.tolerance /= tolerance_by;
  scene.relaxation.rate *= period_by;
  scene.device.servo_rate = 2000.0;
  return scene;
}

Problem stroke_problem(ModelPreset preset, const ProblemOptions& options) {
  const bool paper = preset == ModelPreset::paper;
  const int finest = options.quick ? 4 : 8;
  Problem problem{
      paper ? "stroke-paper" : "stroke-accurate",
      paper ? "A stroke, paper preset" : "A stroke, accurate preset",
      fmt::format("A curved stroke of 4 mm depth at 2 kHz; in place of the truth stands the same "
                  "stroke with cell size, tolerance and relaxation period divided by {}. How far that "
                  "is from their division by {} is the dotted line, so no order is fitted.",
                  finest, finest / 2),
      "l1",
      "misplaced sand, of the sand that moves",
      "",
      {}};
  const Stroke stroke = s_curve(options.quick);
  const auto all = [&](int by) { return refined(preset, by, by, by); };
  const auto truth = std::make_shared<const Replay>(replay(all(finest), stroke));
  problem.converged_to = judge(replay(all(finest / 2), stroke), *truth).l1;
  const auto add = [&](const std::string& series, const std::string& label, const Scene& scene) {
    problem.contenders.push_back(
        stroke_contender(series, label, scene, options.threads, not_applicable, stroke, truth));
  };
  for (int by = 1; by < finest; by *= 2) add("all three finer", fmt::format("1/{} of all", by), all(by));
  for (int by = 1; by <= finest; by *= 2) {
    const Scene scene = refined(preset, by, 1, 1);
    add("cell size alone", fmt::format("{:.3g} cells per radius", scene.tool.radius / scene.bed.cell_size()),
        scene);
  }
  for (const double rate : {15.0, 30.0, 60.0, 120.0, 240.0, 480.0}) {
    Scene scene = all(1);
    scene.relaxation.rate = rate;
    add("relaxation rate alone", fmt::format("{} relaxations a second", rate), scene);
  }
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    Scene scene = all(1);
    scene.relaxation.tolerance = tolerance;
    add("tolerance alone", fmt::format("tolerance {}", tolerance), scene);
  }
  for (const double step_tolerance : {1.0, 0.1, 0.01}) {
    if (paper) break;  // plain passes
    Scene scene = all(1);
    scene.relaxation.step_tolerance = step_tolerance;
    add("step tolerance alone", fmt::format("step tolerance {}", step_tolerance), scene);
  }
  problem.check_errors = [=] {
    return check_errors("5 cells per radius", refined(preset, 1, 1, 1), stroke, *truth);
  };
  return problem;
}

}  // namespace

Problem accurate_stroke_problem(const ProblemOptions& options) {
  return stroke_problem(ModelPreset::accurate, options);
}

Problem paper_stroke_problem(const ProblemOptions& options) {
  return stroke_problem(ModelPreset::paper, options);
}

}  // namespace sandstroke
