// Strokes through simulated grains. Compares their surfaces and forces with the program's.
#include <spdlog/fmt/fmt.h>

#include "validation/study/grain_strokes.h"
#include "validation/study/problem.h"

namespace sandstroke {
namespace {

/// Lists the program's grooves, levees and forces beside the grains'.
std::vector<MeasuredFigure> grain_figures(const GrainStroke& grains, const GrainReply& reply) {
  std::vector<MeasuredFigure> rows;
  const auto add = [&](const char* what, double measured, double model) {
    rows.push_back({grains.name, what, measured, model, "LAMMPS, tests/accuracy/grains"});
  };
  if (grains.way > 0.0) {
    const Groove left = groove_of(grains.change), found = groove_of(reply.change);
    add("groove, mm²", 1e6 * left.area, 1e6 * found.area);
    add("levee, mm", 1e3 * left.levee, 1e3 * found.levee);
    add("force against the motion, mN", 1e3 * grains.against, 1e3 * reply.against);
  }
  add("force upwards, mN", 1e3 * grains.up, 1e3 * reply.up);
  return rows;
}

Plot section_plot(const GrainStroke& grains, const GrainReply& accurate) {
  Plot plot{grains.name,
            "Mean change of the height.",
            grains.way > 0.0 ? "distance from the tool's way" : "distance from the tool's axis",
            "mm",
            "change, mm",
            {},
            {}};
  const auto add = [&](const char* name, Plot::Look look, const std::vector<double>& change) {
    Plot::Curve curve{name, look, {}, {}};
    for (std::size_t bin = 0; bin < change.size(); ++bin) {
      curve.x.push_back(1e3 * grain_bin * (static_cast<double>(bin) + 0.5));
      curve.y.push_back(1e3 * change[bin]);
    }
    plot.curves.push_back(std::move(curve));
  };
  add("accurate, 10 cells per radius", Plot::Look::line, accurate.change);
  add("grains", Plot::Look::points, grains.change);
  return plot;
}

Contender grain_contender(const GrainStroke& grains, ModelPreset preset, int cells_per_radius, int threads) {
  const Scene scene = grain_scene(grains, preset, cells_per_radius);
  return {fmt::format("{}, {}", preset_name(preset), grains.name),
          fmt::format("{} cells per radius", cells_per_radius), settings_of(scene, threads), not_applicable,
          [=] {
            const GrainReply reply = reply_to(grains, scene);
            Trial trial{reply.result.wall_seconds, score_of(reply.result)};
            trial.score.l1 = section_error(reply.change, grains);
            if (preset == ModelPreset::accurate) trial.score.force_error = force_error(reply, grains);
            return trial;
          }};
}

}  // namespace

Problem grains_problem(const ProblemOptions& options) {
  Problem problem{"grains",
                  "Strokes through simulated grains",
                  "A tool goes through beds of grains (discrete elements, R = 8 grains), and through sand "
                  "of the same talus angle; depths count from first touch. The error is the difference of "
                  "the sections over the grains' change.",
                  "l1",
                  "difference of the sections, of the grains' change",
                  "",
                  {}};
  problem.measured_text = "Grains, and the accurate preset with 10 cells per radius and force.law = \"rft\".";
  for (const GrainStroke& grains : grain_strokes) {
    const GrainReply reply = reply_to(grains, grain_scene(grains, ModelPreset::accurate, 10));
    problem.plots.push_back(section_plot(grains, reply));
    for (MeasuredFigure& figure : grain_figures(grains, reply)) problem.measured.push_back(std::move(figure));
    for (const int cells_per_radius : {5, 10, 20}) {
      if (options.quick && cells_per_radius > 10) continue;
      problem.contenders.push_back(
          grain_contender(grains, ModelPreset::accurate, cells_per_radius, options.threads));
    }
    if (grains.shape == ToolShape::sphere)
      problem.contenders.push_back(grain_contender(grains, ModelPreset::paper, 10, options.threads));
  }
  return problem;
}

}  // namespace sandstroke
