// Strokes that no hand would make. The run ends, all numbers are finite, and no sand is lost.
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "validation/stress/judged_run.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

constexpr double half = 0.15;  // m, half of the bed's side
constexpr int cells = 150;     // along each side

/// The hand's position [m] at a time [s].
using Motion = std::function<Eigen::Vector3d(double)>;

struct ExtremeStroke {
  const char* name;
  const char* settings;
  Motion at;
};
using V = Eigen::Vector3d;
const ExtremeStroke strokes[] = {
    {"teleports", "0.2 m from one tick to the next, 100 times a second, 3 mm deep",
     [](double t) { return V(std::fmod(t, 0.02) < 0.01 ? -0.1 : 0.1, 0.0, -0.003); }},
    {"100 m/s", "to and fro at up to 100 m/s, 4 mm deep",
     [](double t) { return V(0.1 * std::sin(1000.0 * t), 0.0, -0.004); }},
    {"vibrates up and down", "between -6 and +2 mm at half the servo rate",
     [](double t) { return V(0.0, 0.0, std::llround(1000.0 * t) % 2 ? -0.006 : 0.002); }},
    {"vibrates to and fro", "by 8 mm at half the servo rate, 5 mm deep",
     [](double t) { return V(std::llround(1000.0 * t) % 2 ? -0.004 : 0.004, 0.0, -0.005); }},
    {"deeper than the radius", "50 mm deep at 0.1 m/s", [](double t) { return V(0.1 * t, 0.0, -0.05); }},
    {"along the wall", "5 mm deep, on the wall", [](double t) { return V(-half + 0.2 * t, half, -0.005); }},
    {"into the corner", "5 mm deep, up to the corner's tip",
     [](double t) { return V(half * t, half * t, -0.005); }},
    {"rests", "6 mm deep", [](double) { return V(0.0, 0.0, -0.006); }},
    {"a metre deep", "down to 1 m at 2 m/s", [](double t) { return V(0.0, 0.0, -std::min(2.0 * t, 1.0)); }},
    {"a kilometre deep", "down to 1000 m at 2 km/s",
     [](double t) { return V(0.0, 0.0, -std::min(2e3 * t, 1e3)); }},
    {"too deep for a double", "down to 1e6 m, where exp(k_c depth) overflows",
     [](double t) { return V(0.02 * t, 0.0, -std::min(2e6 * t, 1e6)); }},
    {"full circles on the spot", "1 mm across at 400 turns a second, 5 mm deep",
     [](double t) {
       const double turn = 2.0 * std::numbers::pi * 400.0 * t;
       return V(0.0005 * std::cos(turn), 0.0005 * std::sin(turn), -0.005);
     }},
};

Stroke stroke_of(const Motion& at, double seconds, double rate) {
  Stroke stroke;
  const auto samples = static_cast<int>(std::llround(seconds * rate));
  for (int i = 0; i <= samples; ++i) {
    stroke.time.push_back(i / rate);
    stroke.position.push_back(at(i / rate));
  }
  return stroke;
}

/// A preset of the program, or the paper's with a plugin law.
struct Model {
  std::string name;
  ModelPreset preset;
  PluginLawSettings plugin_laws = {};
};

std::vector<Model> models_of(const StressOptions& options) {
  if (options.plugin_laws.empty())
    return {{"paper", ModelPreset::paper}, {"accurate", ModelPreset::accurate}};
  std::vector<Model> models;
  for (const PluginLawSettings& plugin_laws : options.plugin_laws)
    models.push_back({"plugin: " + plugin_laws.relaxation + plugin_laws.displacement + plugin_laws.force,
                      ModelPreset::paper, plugin_laws});
  return models;
}

Scene scene_of(const Model& model, DeviceModel device) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 2.0 * half;
  scene.bed.cols = scene.bed.rows = cells;
  scene.device.model = device;
  scene.preset = model.preset;
  apply_model_preset(scene);
  scene.plugin_laws = model.plugin_laws;
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  scene.output.trace = false;
  return scene;
}

/// Runs a stroke on a flat bed and judges it.
StressCase play(const Scene& scene, const Stroke& stroke, std::string name, std::string settings,
                std::vector<Verdict> expected) {
  const JudgedRun run = judged_run(scene, starting_bed(scene.bed), stroke);
  const RunResult& r = run.result;
  const std::string figures =
      fmt::format("{} ticks, {:.3g} N, {:.3g} m deep, volume drift {:.1e} of {:.3g} m^3 moved", r.ticks,
                  r.device.max_force, r.max_depth, r.volume_drift, r.moved_volume);
  return {"strokes",           std::move(name), std::move(settings),
          std::move(expected), run.verdict,     run.reason.empty() ? figures : run.reason};
}

/// Runs one stroke with both devices, with and without a force limit. With a limit, the device's force is
/// bounded at any depth, and hand and mass are a stable linear system: the device stays bounded. Without a
/// limit, the kinematic device cannot diverge. The dynamic device may, but not down to a metre: there
/// k_f |F_r| stays below the 2 m / T that sampled drag bears, or nothing moves sideways. A force that
/// overflows before its limit is refused, too. (Nothing is known of a plugin's force without a limit.)
void play_extreme(StressReport& report, const ExtremeStroke& extreme, const Model& model,
                  const Stroke& stroke) {
  const double deepest = -stroke.position.back().z();
  const bool by_plugin = !model.plugin_laws.force.empty();
  for (const DeviceModel device : {DeviceModel::kinematic, DeviceModel::dynamic})
    for (const bool limited : {true, false}) {
      const bool dynamic = device == DeviceModel::dynamic;
      Scene scene = scene_of(model, device);
      std::vector<Verdict> expected = {Verdict::stable};
      if (deepest > 1.0) {  // the displaced sand stands as a tower, see relaxation_cases.cpp
        scene.relaxation.max_passes = 20;
        expected.push_back(Verdict::not_converged);
      }
      if (!limited) scene.device.max_force = 0.0;
      const bool overflows = !by_plugin && std::isinf(std::exp(scene.force.k_c * deepest));
      if (overflows && !dynamic)
        expected = {Verdict::refused};
      else if (overflows || (dynamic && !limited && (deepest > 1.0 || by_plugin)))
        expected.push_back(Verdict::refused);
      report.cases.push_back(play(scene, stroke,
                                  fmt::format("{}, {}, {}{}", extreme.name, model.name,
                                              dynamic ? "dynamic" : "kinematic", limited ? "" : ", no limit"),
                                  extreme.settings, expected));
    }
}

/// Runs a stroke of hours. A tool that rests, or that never stops, loses no sand in any number of ticks.
void play_long(StressReport& report, const Model& model, const char* name, const Motion& at, double seconds,
               double rate) {
  Stroke stroke = stroke_of(at, seconds, rate);
  stroke.gap_threshold = 2.0 / rate;
  report.cases.push_back(
      play(scene_of(model, DeviceModel::kinematic), stroke, fmt::format("{}, {}", name, model.name),
           fmt::format("5 or 6 mm deep, {:.0f} ticks at 1 kHz", 1000.0 * seconds), {Verdict::stable}));
}

/// Adds strokes that leave the bed or take too long: they must be refused.
void refuse(StressReport& report) {
  const Scene scene = scene_of({"paper", ModelPreset::paper}, DeviceModel::kinematic);
  const Motion leaves = [](double t) { return V(0.2 * t, 0.0, -0.005); };
  report.cases.push_back(play(scene, stroke_of(leaves, 1.0, 1000.0), "over the edge",
                              "5 mm deep, to 50 mm beyond the bed", {Verdict::refused}));
  Stroke endless = stroke_of(leaves, 0.5, 1000.0);
  endless.time.back() = 1e300;
  report.cases.push_back(play(scene, endless, "too long to count its ticks", "1e300 s", {Verdict::refused}));
}

}  // namespace

void stress_strokes(StressReport& report, const StressOptions& options) {
  const double short_ones = options.quick ? 0.8 : 0.05;  // their fraction of the time of all strokes
  const double seconds = options.quick ? 0.5 : 1.0;
  const std::vector<Model> models = models_of(options);
  const double fraction = 1.0 / static_cast<double>(models.size());
  double done = 0.0;
  for (const ExtremeStroke& extreme : strokes)
    for (const Model& model : models) {
      play_extreme(report, extreme, model, stroke_of(extreme.at, seconds, 1000.0));
      options.progress(done += fraction * short_ones / std::size(strokes));
    }
  if (options.plugin_laws.empty()) refuse(report);
  const auto circle = [](double t) { return V(0.06 * std::cos(t), 0.06 * std::sin(t), -0.005); };
  const auto rest = [](double) { return V(0.0, 0.0, -0.006); };
  for (const Model& model : models) {
    play_long(report, model, "rests for long", rest, options.quick ? 20.0 : 3600.0, 1.0);
    options.progress(done += 0.2 * fraction * (1.0 - short_ones));
    play_long(report, model, "circles for long", circle, options.quick ? 20.0 : 1e4, 20.0);
    options.progress(done += 0.8 * fraction * (1.0 - short_ones));
  }
}

}  // namespace sandstroke
