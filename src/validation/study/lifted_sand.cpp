// Sand that a disc lifts, against closed forms.
#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/angle.h"
#include "measure/solution.h"
#include "validation/study/contact_scene.h"
#include "validation/study/exact_shapes.h"
#include "validation/study/problem.h"

namespace sandstroke {
namespace {

constexpr double disc_radius = 0.05, disc_thickness = 0.004;  // m

Scene lift_scene(int cells_per_radius) {
  Scene scene;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.bed.width = scene.bed.depth = 6.0 * disc_radius;
  scene.bed.cols = scene.bed.rows = 6 * cells_per_radius;
  scene.tool.shape = ToolShape::cylinder;
  scene.tool.radius = disc_radius;
  scene.tool.height = disc_thickness;
  scene.tool.solid = scene.tool.carries = true;
  scene.stroke.emplace();
  return scene;
}

/// Lifts the disc, tilted so far [deg], from where its upper side is `depth` [m] below the sand at its
/// middle, until it has left the sand.
Stroke lift(double depth, double tilt) {
  constexpr double speed = 0.2;  // m/s
  const double aside = disc_radius * std::sin(to_radians(tilt)), from = -depth - disc_thickness,
               to = depth + 2.0 * aside;
  Stroke stroke = straight({{0.0, 0.0, from}, {0.0, 0.0, to}}, {(to - from) / speed});
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(to_radians(tilt), Eigen::Vector3d::UnitY()));
  stroke.orientation.assign(stroke.size(), turn.coeffs());
  return stroke;
}

Trial lifted_trial(const Scene& scene, const Stroke& stroke, double exact_volume) {
  const RunResult result = solve(scene, starting_bed(scene.bed), stroke).result;
  Trial trial{result.wall_seconds, score_of(result)};
  trial.score.volume_error = std::abs(result.load->carried / exact_volume - 1.0);
  return trial;
}

}  // namespace

Problem lift_problem(const ProblemOptions& options) {
  Problem problem{"lift",
                  "Sand on a lifted disc",
                  "A disc is lifted out of sand, level or tilted; the truth is the volume of what stays on "
                  "it: a cone over its rim, less its top where it was not buried as deep, or the lower "
                  "envelope of cones over a tilted rim.",
                  "volume_error",
                  "sand that stays on the disc, relative error",
                  "",
                  {}};
  const double slope = talus_slope(lift_scene(10).relaxation.talus_angle);
  constexpr double deep = 0.04, shallow = 0.01;  // m
  const auto add = [&](const char* series, double depth, double tilt, double exact_volume) {
    for (const int cells : {10, 14, 20, 28, 40}) {
      if (options.quick && cells > 20) continue;
      const Scene scene = lift_scene(cells);
      problem.contenders.push_back(
          {series, fmt::format("{} cells per radius", cells), settings_of(scene, options.threads),
           scene.bed.cell_size(),
           [=, stroke = lift(depth, tilt)] { return lifted_trial(scene, stroke, exact_volume); }});
    }
  };
  add("level, from under 10 mm", shallow, 0.0,
      ExactCone{slope, disc_radius - shallow / slope, disc_radius}.volume());
  add("level", deep, 0.0, ExactCone{slope, 0.0, disc_radius}.volume());
  add("tilted by 10 degrees", deep, 10.0, ExactHeapOnPlate{slope, disc_radius, 10.0}.volume());
  add("tilted by 20 degrees", deep, 20.0, ExactHeapOnPlate{slope, disc_radius, 20.0}.volume());
  add("tilted by 25 degrees", deep, 25.0, ExactHeapOnPlate{slope, disc_radius, 25.0}.volume());
  return problem;
}

}  // namespace sandstroke
