// A tool that goes round and round in sand: the contact force (force.law = "rft", "archimedes") takes energy.
#include <spdlog/fmt/fmt.h>

#include <array>
#include <cmath>
#include <numbers>

#include "validation/stress/judged_run.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

constexpr int ticks_per_turn = 250, turns = 6;
constexpr double rate = 1000.0;                 // Hz
constexpr double depth = 0.012, plunge = 0.25;  // m, s

/// The energy that sand took for good in each turn: the hand's work, less the growth of what is stored. The
/// force after each tick counts, for a held force is a tick late.
class TakenByTurn : public SimulationObserver {
 public:
  void on_tick(const TickRecord& tick) override {
    const Eigen::Vector3d at = tick.hand.position;
    const double since = std::round((tick.time - plunge) * rate);  // ticks since the first turn began
    const auto turn = static_cast<std::size_t>(std::max(0.0, std::ceil(since / ticks_per_turn)));
    if (turn < joules.size())
      joules[turn] -= tick.wrench.force.dot(at - before_) + tick.wrench.stored - stored_;
    before_ = at;
    stored_ = tick.wrench.stored;
  }
  std::array<double, turns + 1> joules{};  ///< in the plunge, then in each turn

 private:
  Eigen::Vector3d before_ = Eigen::Vector3d::Zero();
  double stored_ = 0.0;  // J
};

/// Down, and then round an upright circle of this radius [m].
Stroke loop(double radius) {
  Stroke stroke;
  const auto add = [&](double time, double x, double z) {
    stroke.time.push_back(time);
    stroke.position.emplace_back(x, 0.0, z);
  };
  for (int i = 0; i <= static_cast<int>(plunge * rate); ++i) add(i / rate, 0.0, -depth * i / (plunge * rate));
  for (int i = 1; i <= turns * ticks_per_turn; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / ticks_per_turn;
    add(plunge + i / rate, radius * (std::cos(angle) - 1.0), -depth + radius * std::sin(angle));
  }
  return stroke;
}

Scene loop_scene(ForceLaw law, ToolShape shape) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.16;
  scene.bed.cols = scene.bed.rows = 160;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.force.law = law;
  scene.tool.shape = shape;
  scene.tool.width = 0.03;
  scene.device.max_force = 0.0;
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  scene.output.trace = false;
  return scene;
}

JudgedRun judged_loop(const Scene& scene, double radius) {
  TakenByTurn taken;
  JudgedRun run = judged_run(scene, starting_bed(scene.bed), loop(radius), {&taken});
  if (run.verdict != Verdict::stable) return run;
  const double rounding = 1e-9 * taken.joules[0];
  for (std::size_t turn = 1; turn <= turns; ++turn) {
    if (taken.joules[turn] >= -rounding) continue;
    run.verdict = Verdict::diverged;
    run.reason = fmt::format("turn {} gave {:.3g} J that was not stored; the plunge took {:.3g} J", turn,
                             -taken.joules[turn], taken.joules[0]);
    break;
  }
  return run;
}

}  // namespace

void stress_contact_loops(StressReport& report, const StressOptions& options) {
  constexpr struct {
    ForceLaw law;
    ToolShape shape;
    const char* name;
  } kinds[] = {{ForceLaw::rft, ToolShape::sphere, "rft, sphere"},
               {ForceLaw::rft, ToolShape::plate, "rft, blade"},
               {ForceLaw::archimedes, ToolShape::sphere, "archimedes, sphere"}};
  double done = 0.0;
  for (const auto& kind : kinds) {
    const Scene scene = loop_scene(kind.law, kind.shape);
    Variations loops("contact loops", fmt::format("closed loops take energy, {}", kind.name),
                     "upright circles of 0.05 to 3 yields in radius, 12 mm deep, six turns each",
                     {Verdict::stable});
    for (const double yields : {0.05, 0.1, 0.3, 0.5, 1.0, 3.0}) {
      if (options.quick && yields != 0.3 && yields != 3.0) continue;
      loops.add(judged_loop(scene, yields * scene.strength.yield_way), fmt::format("{} yields", yields));
    }
    report.cases.push_back(loops.done());
    options.progress(done += 1.0 / std::size(kinds));
  }
}

}  // namespace sandstroke
