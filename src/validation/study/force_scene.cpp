#include "validation/study/force_scene.h"

#include <cmath>

#include "measure/solution.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

/// Keeps the force of the last tick.
class LastWrench : public SimulationObserver {
 public:
  void on_tick(const TickRecord& tick) override { force = tick.wrench.force; }
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N
};

constexpr double speed = 0.05;  // m/s

Eigen::Vector3d off_every_grid_line(double cell, double height) { return {0.3 * cell, 0.17 * cell, height}; }

}  // namespace

Scene force_scene(const ToolSettings& tool, double cell, double tool_friction) {
  constexpr double width = 0.16;  // m
  Scene scene = solid_contact_scene(width, static_cast<int>(std::lround(width / cell)), tool);
  scene.tool.profile = ToolProfile::sphere;
  scene.force.law = ForceLaw::rft;
  scene.strength.tool_friction = tool_friction;
  scene.strength.yield_way = 1e-6;
  return scene;
}

Stroke push(double cell, double depth, double drag) {
  constexpr double above = 0.001;  // m
  const Eigen::Vector3d deep = off_every_grid_line(cell, -depth);
  std::vector<Eigen::Vector3d> positions = {off_every_grid_line(cell, above), deep};
  std::vector<double> seconds = {(above + depth) / speed};
  if (drag > 0.0) {
    positions.push_back(deep + drag * Eigen::Vector3d::UnitX());
    seconds.push_back(drag / speed);
  }
  return straight(positions, seconds);
}

Stroke nudge(double cell, double depth, const Eigen::Vector3d& direction) {
  constexpr double way = 2e-5, seconds = 0.01;  // m: 20 yield ways in 10 ticks
  const Eigen::Vector3d from = off_every_grid_line(cell, -depth);
  return straight({from, from + way * direction}, {seconds});
}

Contender force_contender(const std::string& series, const std::string& label, const Scene& scene,
                          const HeightField& bed, int threads, double step, const Stroke& stroke, int axis,
                          double exact) {
  return {series, label, settings_of(scene, threads), step, [=] {
            LastWrench last;
            const RunResult result = solve(scene, bed, stroke, {&last}).result;
            Trial trial{result.wall_seconds, score_of(result)};
            trial.score.converged = true;  // no relaxation was asked for
            trial.score.force_error = std::abs(last.force[axis] / exact - 1.0);
            return trial;
          }};
}

Problem force_problem(const char* name, const char* title, const char* text) {
  return {name, title, text, "force_error", "force, relative error", "", {}};
}

}  // namespace sandstroke
