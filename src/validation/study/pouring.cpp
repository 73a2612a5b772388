// Sand that is poured from a point, against the cone of its volume.
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "core/angle.h"
#include "core/elementary.h"
#include "core/stopwatch.h"
#include "measure/solution.h"
#include "validation/study/shape_score.h"

namespace sandstroke {
namespace {

constexpr double volume_rate = 4e-6, fall_height = 0.1, pouring_seconds = 6.0;  // m^3/s, m, s
constexpr double poured_bed_width = 0.16;                                       // m

Scene poured_scene(int cells, RelaxationLaw law, double rate) {
  Scene scene;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.relaxation.law = law;
  scene.relaxation.rate = rate;
  scene.bed.width = scene.bed.depth = poured_bed_width;
  scene.bed.cols = scene.bed.rows = cells;
  SourceSettings& source = scene.sources.emplace_back();
  source.at.z() = fall_height;
  source.rate = volume_rate * scene.strength.density;
  source.stop = pouring_seconds;
  return scene;
}

Trial pour(const Scene& scene) {
  const double slope = elementary::tan(to_radians(scene.relaxation.talus_angle)),
               foot = std::cbrt(3.0 * volume_rate * pouring_seconds / (std::numbers::pi * slope));
  const ExactCone cone{slope, 0.0, foot};
  const HeightField start = starting_bed(scene.bed);
  const Stopwatch watch;
  const Solution end = solve(scene, start);
  Trial trial{watch.seconds(), score_of(end.surface, start, end.result.relaxation,
                                        {cone, cone.top(), Flank{slope, 0.0, foot}})};
  trial.score.volume_drift = end.result.volume_drift;
  return trial;
}

}  // namespace

Problem poured_problem(const ProblemOptions& options) {
  Problem problem = shape_problem(
      "poured", "Poured cone",
      "Sand falls 0.1 m onto a point for 6 s, and relaxes as it lands; the truth is the talus cone of its "
      "volume, whose apex is blunt by a few cells.");
  for (const auto& [series, law, rate] : {std::tuple("isotropic", RelaxationLaw::isotropic, 60.0),
                                          std::tuple("isotropic, 15 Hz", RelaxationLaw::isotropic, 15.0),
                                          std::tuple("faces", RelaxationLaw::faces, 60.0)})
    for (const int cells : {32, 48, 64, 96, 128, 192}) {
      if (options.quick && cells > 64) continue;
      const Scene scene = poured_scene(cells, law, rate);
      problem.contenders.push_back({series, fmt::format("{} cells", cells),
                                    settings_of(scene, options.threads), scene.bed.cell_size(),
                                    [scene] { return pour(scene); }});
    }
  return problem;
}

}  // namespace sandstroke
