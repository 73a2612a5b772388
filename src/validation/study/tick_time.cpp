// The time of a tick in sand under each force law.
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <cstdint>

#include "core/stopwatch.h"
#include "measure/solution.h"
#include "sim/simulation.h"
#include "tool/tool_surface.h"
#include "validation/study/contact_scene.h"
#include "validation/study/problem.h"

namespace sandstroke {
namespace {

/// Measures the time from the first tick that touches sand to the last one, and counts the ticks between.
class TickTimer : public SimulationObserver {
 public:
  void on_tick(const TickRecord& tick) override {
    if (!tick.contact) return;
    if (ticks_++ == 0) watch_ = Stopwatch();
    seconds_ = watch_.seconds();
  }
  double seconds() const { return seconds_; }
  double ticks() const { return static_cast<double>(ticks_ - 1); }

 private:
  Stopwatch watch_;
  double seconds_ = 0.0;
  std::int64_t ticks_ = 0;
};

struct Law {
  const char* name;
  ForceLaw law;
};

Contender tick_contender(const std::string& tool, const Law& law, const std::string& label, Scene scene,
                         const Stroke& stroke) {
  scene.force.law = law.law;
  Contender contender{fmt::format("{}, {}", law.name, tool), label, settings_of(scene, 1), not_applicable,
                      nullptr};
  contender.settings.force_law = law.name;
  contender.settings.tool = tool;
  contender.run = [=] {
    TickTimer timer;
    const RunResult result = solve(scene, starting_bed(scene.bed), stroke, {&timer}).result;
    Trial trial{timer.seconds(), score_of(result)};
    trial.score.converged = true;  // no relaxation was asked for
    trial.score.timed_ticks = timer.ticks();
    return trial;
  };
  return contender;
}

}  // namespace

Problem tick_problem(const ProblemOptions& options) {
  Problem problem{
      "ticks",
      "Time of a tick",
      "A tool is dragged at 0.1 m/s and 1 kHz through flat sand that does not relax, on one thread: "
      "the same ticks under each law of the force.",
      "tick_microseconds",
      "time of a tick",
      "µs",
      {}};
  problem.times_ticks = true;
  ToolSettings sphere, blade;
  sphere.profile = ToolProfile::sphere;
  blade.shape = ToolShape::plate;
  blade.width = 0.04;
  ToolSettings mesh = sphere;
  mesh.shape = ToolShape::mesh;
  mesh.mesh = std::make_shared<TriangleMesh>(tool_surface(sphere));
  constexpr Law laws[] = {
      {"paper", ForceLaw::paper}, {"rft", ForceLaw::rft}, {"archimedes", ForceLaw::archimedes}};
  const double way = options.quick ? 0.02 : 0.1, speed = 0.1;  // m, m/s
  const auto add = [&](const std::string& name, const ToolSettings& tool, int cells_per_radius,
                       double depth) {
    constexpr double width = 0.2;  // m
    const Scene scene = solid_contact_scene(
        width, static_cast<int>(std::lround(width / sphere.radius)) * cells_per_radius, tool);
    const Stroke stroke = straight({{-0.5 * way, 0.0, -depth}, {0.5 * way, 0.0, -depth}}, {way / speed});
    for (const Law& law : laws)
      problem.contenders.push_back(tick_contender(
          name, law, fmt::format("{:.0f} mm deep, {} cells per radius", 1e3 * depth, cells_per_radius), scene,
          stroke));
  };
  for (const int cells_per_radius : {5, 10, 20}) add("sphere", sphere, cells_per_radius, 0.005);
  for (const double depth : {0.002, 0.01, 0.02}) add("sphere", sphere, 10, depth);
  for (const int cells_per_radius : {5, 10, 20}) add("sphere as a mesh", mesh, cells_per_radius, 0.005);
  for (const int cells_per_radius : {5, 10, 20}) add("blade", blade, cells_per_radius, 0.005);
  return problem;
}

}  // namespace sandstroke
