// The work of a kinematic device in sand, against closed forms.
#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "sim/simulation.h"
#include "validation/study/contact_scene.h"
#include "validation/study/error_checks.h"
#include "validation/study/exact_shapes.h"
#include "validation/study/plugin_contenders.h"
#include "validation/study/problem.h"

namespace sandstroke {
namespace {

Trial work_trial(const Scene& scene, const HeightField& bed, const Stroke& stroke, double exact_work) {
  const RunResult result = solve(scene, bed, stroke).result;
  Trial trial{result.wall_seconds, score_of(result)};
  trial.score.work_error = std::abs(result.device.absorbed_energy / exact_work - 1.0);
  return trial;
}

Contender work_contender(const std::string& series, const std::string& label, const Scene& scene, int threads,
                         double step, std::function<Trial()> run, bool external = false) {
  return {series, label, settings_of(scene, threads), step, std::move(run), external};
}

Problem work_problem(const char* name, const char* title, const std::string& text) {
  return {name, title, text, "work_error", "work, relative error", "", {}};
}

}  // namespace

Problem plunge_problem(const ProblemOptions& options) {
  Problem problem = work_problem("plunge", "Work of a plunge",
                                 "The tip is pushed 10 mm into flat sand at 20 mm/s, with drag in all "
                                 "directions; the work is known in closed form.");
  constexpr double depth = 0.01, speed = 0.02, above = 0.001;  // m, m/s, m
  const std::vector<double> rates = {62.5, 125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0, 16000.0};
  const Stroke stroke = straight({{0.0, 0.0, above}, {0.0, 0.0, -depth}}, {(above + depth) / speed});
  const auto at_rate = [](double rate) {
    Scene scene = contact_scene(0.2, 100, rate);
    scene.force.drag = DragDirection::full;
    return scene;
  };
  for (const double rate : rates) {
    const Scene scene = at_rate(rate);
    const double exact = plunge_work(depth, scene.force) * (1.0 + scene.force.k_f * speed);
    problem.contenders.push_back(work_contender(
        "force held for a tick", fmt::format("servo rate {} Hz", rate), scene, options.threads, 1.0 / rate,
        [=] { return work_trial(scene, starting_bed(scene.bed), stroke, exact); }));
  }
  for (const PluginLawSettings& own : options.plugin_laws) {
    if (own.force.empty()) continue;
    problem.text += " A plugin's law is compared with itself at 128 kHz.";
    const auto by_law = [=](double rate) {
      Scene scene = at_rate(rate);
      scene.plugin_laws = own;
      return scene;
    };
    const auto law_truth = truth_when_asked<double>([=] {
      const Scene finer = by_law(8.0 * rates.back());
      return solve(finer, starting_bed(finer.bed), stroke).result.device.absorbed_energy;
    });
    for (const double rate : rates)
      problem.contenders.push_back(work_contender(
          series_of(own), fmt::format("servo rate {} Hz", rate), by_law(rate), options.threads, 1.0 / rate,
          [=] { return work_trial(by_law(rate), starting_bed(by_law(rate).bed), stroke, law_truth()); },
          true));
  }
  return problem;
}

Problem drag_problem(const ProblemOptions& options) {
  // The tip fits into a slot without touching the sand. Nothing is displaced, so depth and force stay
  // constant. The level is the mean over a disk across the slot.
  Problem problem =
      work_problem("drag", "Work of a drag",
                   "The tip is drawn along a slot that it fits into without touching the sand, so "
                   "that depth and drag stay what the closed form says.");
  constexpr double length = 0.1, speed = 0.1;  // m, m/s
  for (const double cells_per_radius : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 8.0, 12.0, 16.0, 24.0, 32.0}) {
    if (options.quick && cells_per_radius > 16.0) continue;
    const double radius = ToolSettings{}.radius, half_width = 0.6 * radius, slot_depth = 0.16 * radius;
    const auto cells = static_cast<int>(std::lround(20.0 * cells_per_radius));
    Scene scene = contact_scene(20.0 * radius, cells, 1000.0);
    scene.relaxation.talus_angle = 89.9;  // the walls stand
    HeightField bed(cells, cells, scene.bed.cell_size());
    const double dx = bed.cell_size(), centre = 0.13 * dx;  // m, the slot's middle, off every grid line
    for (int row = 0; row < cells; ++row) {
      const double from_wall = half_width - std::abs(bed.y_of(row) - centre);
      const double fraction = std::clamp(from_wall / dx + 0.5, 0.0, 1.0);  // fraction of the cell in the slot
      for (int col = 0; col < cells && fraction > 0.0; ++col) bed.set(row, col, -slot_depth * fraction);
    }
    bed.clear_disturbed();
    const double level = -slot_depth * strip_fraction_of_disk(make_tool(scene.tool)->reach(), half_width);
    const double tip = -0.97 * slot_depth;
    const double exact = drag_work(level - tip, speed, length, scene.force);
    const Stroke stroke =
        straight({{-0.5 * length, centre, tip}, {0.5 * length, centre, tip}}, {length / speed});
    if (cells_per_radius == 8.0) {
      Scene cell_by_cell = scene;
      cell_by_cell.bed.surface.kind = SurfaceKind::file;
      cell_by_cell.bed.surface.file = "in memory";
      const SandForce exact_force = sand_force(level - tip, {speed, 0.0, 0.0}, 0.0, scene.force);
      problem.check_errors = [=] {
        return check_errors(
            "8 cells per radius", cell_by_cell, bed, stroke,
            [&](const HeightField&, const std::vector<Eigen::Vector3d>& forces) {
              double squares = 0.0;
              for (const Eigen::Vector3d& force : forces)
                squares += (force - exact_force.total).squaredNorm();
              return TrueError{.force_rms = std::sqrt(squares / static_cast<double>(forces.size()))};
            });
      };
    }
    problem.contenders.push_back(
        work_contender("cell size", fmt::format("{} cells per radius", cells_per_radius), scene,
                       options.threads, dx, [=] { return work_trial(scene, bed, stroke, exact); }));
  }
  return problem;
}

}  // namespace sandstroke
