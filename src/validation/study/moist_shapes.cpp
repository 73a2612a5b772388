// Moist sand: at which height cuts fail, and how it lies then, against closed forms.
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <memory>

#include "core/angle.h"
#include "core/stopwatch.h"
#include "sand/standing_sand.h"
#include "validation/study/shape_score.h"
#include "validation/study/standing_cut.h"

namespace sandstroke {
namespace {

constexpr double friction_of_moist = 33.0;  // deg; its loose sand rests at that angle, too

/// A vertical wall that has failed along Rankine's plane: what slid off lies before it at the talus. The wall
/// stood at x = 0.
struct FailedWall {
  double height, plane, talus;  // m; slopes, rise over run

  /// Height of the loose sand at x = 0 [m]. It has the volume of the wedge.
  double loose() const { return height * std::sqrt(1.0 / plane / (1.0 / talus + 1.0 / (plane - talus))); }
  double operator()(double x) const {
    const double loose_sand = loose() + talus * x, intact = plane * x;
    return std::min(height, std::max({0.0, intact, loose_sand > intact ? loose_sand : 0.0}));
  }
};

/// A wall a twentieth too high, which loses its wedge.
Trial failed_wall(int cells, const RelaxationSettings& settings) {
  const CohesionFactor factor(SlipSurface::plane, friction_of_moist);
  const double of_cut = critical_height(SlipSurface::plane, 90.0, friction_of_moist);  // c / gamma is 1 m
  const FailedWall exact{1.05 * of_cut, std::tan(to_radians(45.0 + 0.5 * friction_of_moist)),
                         talus_slope(friction_of_moist)};
  HeightField bed(1, cells, 3.0 * of_cut / cells);
  for (int col = 0; col < cells; ++col) bed.set(0, col, bed.x_of(col) > 0.0 ? exact.height : 0.0);
  const StandingSand sand{factor, {1.0}, 0.0, true, exact.talus};
  return relaxed_trial(
      bed, {[=](double x, double) { return exact(x); }, exact.height, {}}, [&](HeightField& its) {
        return make_standing_relaxer(make_relaxer(settings, its.cell_size()), its, sand)->relax(its);
      });
}

}  // namespace

Problem cut_problem(const ProblemOptions& options) {
  Problem problem{"cut",
                  "Cuts through moist sand",
                  "Straight cuts through moist sand; the truth is the height at which the worst log-spiral "
                  "through the toe fails (Chen 1975).",
                  "cut_error",
                  "height at which it fails, relative error",
                  "",
                  {}};
  for (const auto& [face, turn] : {std::pair(90.0, 0.0), std::pair(90.0, 22.5), std::pair(90.0, 45.0),
                                   std::pair(75.0, 22.5), std::pair(60.0, 22.5), std::pair(45.0, 22.5)})
    for (const int cells : {10, 20, 40, 80}) {
      if (options.quick && cells > 40) continue;
      const StandingCut cut{.face = face, .turn = turn, .shift = 0.3, .cells = cells};
      RunSettings settings;
      settings.cells = cells;
      settings.cell_size = 1.0 / cells;  // heights
      settings.threads = options.threads;
      problem.contenders.push_back(
          {turn > 0.0 ? fmt::format("{:g} deg, turned by {:g}", face, turn) : fmt::format("{:g} deg", face),
           fmt::format("{} cells", cells), settings, settings.cell_size, [cut] {
             const Stopwatch watch;
             Trial trial;
             trial.score.cut_error = std::abs(height_error(cut, SlipSurface::spiral));
             trial.seconds = watch.seconds();
             return trial;
           }});
    }
  return problem;
}

Problem wall_problem(const ProblemOptions& options) {
  Problem problem = shape_problem(
      "wall", "A wall of moist sand that fails",
      "A vertical wall that is 5 % too high loses the wedge above a plane of 45 degrees and half "
      "the friction angle; the truth is that plane, with the wedge's sand before it at the talus.");
  for (const RelaxationLaw law : {RelaxationLaw::isotropic, RelaxationLaw::faces})
    for (const int cells : {48, 96, 192, 384}) {
      if (options.quick && cells > 192) continue;
      RelaxationSettings settings{.law = law, .method = RelaxationMethod::rkl};
      settings.talus_angle = friction_of_moist;
      settings.tolerance = 1e-5;
      const HeightField bed(1, cells, 1.0 / cells);
      problem.contenders.push_back({fmt::format("{} rkl", relaxation_law_names[static_cast<int>(law)]),
                                    fmt::format("{} cells", cells),
                                    settings_of(settings, bed, options.threads), 1.0 / cells,
                                    [cells, settings] { return failed_wall(cells, settings); }});
    }
  return problem;
}

}  // namespace sandstroke
