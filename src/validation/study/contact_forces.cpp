// The contact force (force.law = "rft"), against closed forms and the theory summed over a sphere.
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <numbers>

#include "validation/study/force_scene.h"
#include "validation/study/measured_stress.h"

namespace sandstroke {
namespace {

/// The theory itself, without cells: sums the force over the leading part of a sphere's surface, by latitude
/// and longitude.
Eigen::Vector3d theory_of_sphere(double radius, double depth, const Eigen::Vector3d& motion,
                                 const SandStrength& sand) {
  constexpr int rings = 400, sectors = 400;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  const double lowest = -1.0, highest = std::min(depth / radius - 1.0, 1.0);  // z / R from the centre
  const double area = 2.0 * std::numbers::pi * radius * radius * (highest - lowest) / (rings * sectors);
  for (int ring = 0; ring < rings; ++ring) {
    const double z = lowest + (highest - lowest) * (ring + 0.5) / rings, r = std::sqrt(1.0 - z * z);
    for (int sector = 0; sector < sectors; ++sector) {
      const double angle = 2.0 * std::numbers::pi * (sector + 0.5) / sectors;
      const Eigen::Vector3d normal(r * std::cos(angle), r * std::sin(angle), z);
      if (normal.dot(motion) < 0.0) continue;
      force += resistance(sand) * (depth - radius * (1.0 + z)) * area *
               resistive_stress(normal, motion, sand.tool_friction);
    }
  }
  return force;
}

}  // namespace

Problem plate_force_problem(const ProblemOptions& options) {
  Problem problem = force_problem("force-plate", "Force on a plate and a blade (rft)",
                                  "A smooth round plate of area A is pushed d deep: 0.87574 ξ A d. A "
                                  "smooth blade is dragged face on: "
                                  "0.192 ξ A d, d now to the middle of its face. ξ is the sand's "
                                  "resistance. The plate's error is "
                                  "the area that it lacks as a polygon, whatever the cells.");
  problem.plots = stress_plots();
  problem.measured_text =
      "Stress over depth. Where no unit is named, it is that of the medium's flat plate pushed straight "
      "down.";
  problem.measured = measured_stresses();
  constexpr double depth = 0.0105;  // m
  ToolSettings plate, blade;
  plate.shape = ToolShape::cylinder;
  blade.shape = ToolShape::plate;
  blade.width = 0.04;
  blade.height = 0.03;
  blade.thickness = 0.004;
  for (const double cell : {0.002, 0.001, 0.0005, 0.00025}) {
    if (options.quick && cell < 0.0005) continue;
    const std::string label = fmt::format("cells of {:.3g} mm", 1e3 * cell);
    const Scene pushed = force_scene(plate, cell, 0.0), dragged = force_scene(blade, cell, 0.0);
    const double xi = resistance(pushed.strength);
    problem.contenders.push_back(force_contender(
        "plate pushed down", label, pushed, starting_bed(pushed.bed), options.threads, not_applicable,
        push(cell, depth, 0.0), 2, 0.87574 * xi * std::numbers::pi * plate.radius * plate.radius * depth));
    problem.contenders.push_back(force_contender(
        "blade dragged face on", label, dragged, starting_bed(dragged.bed), options.threads, cell,
        push(cell, depth, 0.006), 0, -0.192 * xi * blade.width * depth * (0.5 * depth)));
  }
  return problem;
}

Problem sphere_force_problem(const ProblemOptions& options) {
  Problem problem =
      force_problem("force-sphere", "Force on a sphere (rft)",
                    "A sphere of 10 mm radius is pushed into the sand, and dragged; the truth is resistive "
                    "force theory, summed over the leading surface. No order is fitted for the drag: parts "
                    "that trail by less than 1 degree count a little in the program, with any cells.");
  const ToolSettings sphere{0.01};
  for (const int cells_per_radius : {5, 10, 20, 40}) {
    if (options.quick && cells_per_radius > 20) continue;
    const Scene scene = force_scene(sphere, sphere.radius / cells_per_radius, SandStrength{}.tool_friction);
    const std::string label = fmt::format("{} cells per radius", cells_per_radius);
    const auto add = [&](const std::string& series, double depth, double drag) {
      const bool drags = drag > 0.0;
      const Eigen::Vector3d motion = drags ? Eigen::Vector3d::UnitX() : Eigen::Vector3d(0.0, 0.0, -1.0);
      const int axis = drags ? 0 : 2;
      problem.contenders.push_back(force_contender(
          series, label, scene, starting_bed(scene.bed), options.threads,
          drags ? not_applicable : scene.bed.cell_size(), push(scene.bed.cell_size(), depth, drag), axis,
          theory_of_sphere(sphere.radius, depth, motion, scene.strength)[axis]));
    };
    for (const double depth : {0.004, 0.006, 0.01})
      add(fmt::format("pushed {:.0f} mm deep", 1e3 * depth), depth, 0.0);
    add("dragged, 6 mm deep", 0.006, 0.006);
  }
  return problem;
}

}  // namespace sandstroke
