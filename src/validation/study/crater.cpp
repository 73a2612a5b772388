// Sand that drains through a hole. Compares each law with the steepest shape that it allows.
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <tuple>

#include "core/stopwatch.h"
#include "validation/study/shape_score.h"

namespace sandstroke {
namespace {

constexpr double crater_bed_width = 2.0, depth = 0.25;  // m
constexpr double hole_radius = 0.1;  // m: a hole of one cell would be a point, of infinite curvature

/// Cuts the sand in the hole down to the crater and relaxes the bed, until no more sand flows.
Trial drain(int cells, const ExactCrater& crater, const RelaxationSettings& settings) {
  const HeightField start(cells, cells, crater_bed_width / cells);
  HeightField bed = start;
  const Stopwatch watch;
  const auto relaxer = make_relaxer(settings, bed.cell_size());
  RelaxationOutcome total;
  for (bool flowed = true; flowed; flowed = flowed && total.converged) {
    for (int row = 0; row < cells; ++row)
      for (int col = 0; col < cells; ++col) {
        const double x = bed.x_of(col), y = bed.y_of(row);
        if (std::hypot(x, y) > hole_radius) continue;
        if (bed(row, col) > crater(x, y)) bed.set(row, col, crater(x, y));
      }
    const RelaxationOutcome outcome = relaxer->relax(bed);
    flowed = outcome.passes > 0;
    total.passes += outcome.passes;
    total.cells_visited += outcome.cells_visited;
    total.converged = outcome.converged;
  }
  return {watch.seconds(),
          score_of(bed, start, total,
                   {crater, crater.depth, Flank{crater.slope, hole_radius, crater.depth / crater.slope}})};
}

}  // namespace

Problem crater_problem(const ProblemOptions& options) {
  Problem problem =
      shape_problem("octagon", "Drained crater: octagon or cone",
                    "Sand drains through a hole until none flows. All sand of the crater's slope has slid, "
                    "so the truth is the steepest shape of the law: the paper's octagon, or a cone.");
  const auto add = [&](const std::string& series, const std::string& label, int cells,
                       const RelaxationSettings& settings, double step) {
    const double dx = crater_bed_width / cells;
    Contender contender{series, label, settings_of(settings, BedGeometry(cells, cells, dx), options.threads),
                        step, nullptr};
    contender.run = [=] {
      return drain(cells, drained_crater(depth, settings.talus_angle, settings.law), settings);
    };
    problem.contenders.push_back(std::move(contender));
  };
  using enum RelaxationLaw;
  using enum RelaxationMethod;
  for (const auto& [series, law, method] :
       {std::tuple("paper passes", paper, passes), std::tuple("paper rkl", paper, rkl),
        std::tuple("isotropic passes", isotropic, passes), std::tuple("isotropic rkl", isotropic, rkl)})
    for (const int cells : {32, 48, 64, 96, 128, 192, 256}) {
      if (options.quick && cells > 96) continue;
      add(series, fmt::format("{} cells", cells), cells, {.law = law, .method = method},
          crater_bed_width / cells);
    }
  for (const double tolerance : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4}) {
    RelaxationSettings settings{.law = paper, .method = passes};
    settings.tolerance = tolerance;
    add("paper passes, tolerance", fmt::format("tolerance {}, 64 cells", tolerance), 64, settings,
        not_applicable);
  }
  return problem;
}

}  // namespace sandstroke
