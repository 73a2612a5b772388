// The sand that a tool feels (force.law = "rft"): under faces that look up, before a heap, in a furrow.
#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "core/angle.h"
#include "sim/simulation.h"
#include "tool/tool_elements.h"
#include "tool/tool_surface.h"
#include "validation/study/force_scene.h"

namespace sandstroke {
namespace {

constexpr double cells[] = {0.002, 0.001, 0.0005, 0.00025};  // m

std::string label_of(double cell) { return fmt::format("cells of {:.3g} mm", 1e3 * cell); }

ToolSettings blade(double lean) {
  ToolSettings tool;
  tool.shape = ToolShape::plate;
  tool.width = tool.height = 0.04;
  tool.orientation.y() = lean;
  return tool;
}

/// The theory itself, without cells: the force on all of the surface that leads below level sand, `depth` [m]
/// above the tip, in parts of 1/4 mm.
Eigen::Vector3d theory_of(const ToolSettings& tool, double depth, const Eigen::Vector3d& direction,
                          const SandStrength& sand) {
  ToolElements parts(tool_surface(tool), 0.00025);
  parts.turn(own_rotation(tool));
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int i = 0; i < parts.count(); ++i) {
    const Eigen::Vector3d normal(parts.normal_x()[i], parts.normal_y()[i], parts.normal_z()[i]);
    const double below = depth - parts.z()[i];
    if (below > 0.0 && normal.dot(direction) > -1e-9)
      force += resistance(sand) * below * parts.area()[i] *
               resistive_stress(normal, direction, sand.tool_friction);
  }
  return force;
}

/// Adds runs of a tool in level sand, with ever smaller cells, against the theory.
void add_level(Problem& problem, const ProblemOptions& options, const std::string& series,
               const ToolSettings& tool, double depth, const Eigen::Vector3d& direction, int axis) {
  for (const double cell : cells) {
    if (options.quick && cell < 0.0005) continue;
    const Scene scene = force_scene(tool, cell, SandStrength{}.tool_friction);
    problem.contenders.push_back(force_contender(series, label_of(cell), scene, starting_bed(scene.bed),
                                                 options.threads, cell, nudge(cell, depth, direction), axis,
                                                 theory_of(tool, depth, direction, scene.strength)[axis]));
  }
}

/// The scene's bed, with the height [m] at each x, y [m].
template <class Height>
HeightField bed_of(const Scene& scene, const Height& height) {
  HeightField bed = starting_bed(scene.bed);
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) bed.set(row, col, height(bed.x_of(col), bed.y_of(row)));
  bed.clear_disturbed();
  return bed;
}

}  // namespace

Problem leaning_problem(const ProblemOptions& options) {
  Problem problem =
      force_problem("leaning", "Drag on a blade that leans (rft)",
                    "A blade 12 mm deep is dragged. Where it leans back its face looks up, and sand "
                    "closes over it; the truth is resistive force theory, summed over all of the "
                    "surface that leads.");
  for (const double lean : {-45.0, -20.0, -10.0, 0.0, 10.0, 20.0, 45.0})
    add_level(problem, options,
              lean == 0.0 ? "upright"
                          : fmt::format("leans {} by {:.0f}°", lean < 0.0 ? "back" : "ahead", std::abs(lean)),
              blade(lean), 0.012, Eigen::Vector3d::UnitX(), 0);
  return problem;
}

Problem pulled_problem(const ProblemOptions& options) {
  Problem problem =
      force_problem("pulled", "Force on a plate that is pulled up (rft)",
                    "A round plate, 4 mm thick, is pulled straight up from 12 and 24 mm. The height "
                    "field has no sand above it; the law has. The truth is resistive force theory.");
  ToolSettings plate;
  plate.shape = ToolShape::cylinder;
  plate.radius = 0.02;
  plate.height = 0.004;
  for (const double depth : {0.012, 0.024})
    add_level(problem, options, fmt::format("{:.0f} mm deep", 1e3 * depth), plate, depth,
              Eigen::Vector3d::UnitZ(), 2);
  return problem;
}

Problem heap_force_problem(const ProblemOptions& options) {
  Problem problem = force_problem(
      "heap", "Drag on a blade before its heap (rft)",
      "A smooth blade of width W pushes a heap that stands h over the blade's foot and falls "
      "away at the angle of friction φ. The truth is Coulomb's wedge: the force is (1 - sin φ)² "
      "times that in level sand, 0.192 ξ W h² / 2. A heap of 0 mm is level sand.");
  constexpr double depth = 0.006;  // m
  const ToolSettings tool = blade(0.0);
  for (const double heap : {0.0, 0.006, 0.012})
    for (const double cell : cells) {
      if (options.quick && cell < 0.0005) continue;
      const Scene scene = force_scene(tool, cell, 0.0);
      const SandStrength& sand = scene.strength;
      const double phi = to_radians(sand.friction_angle), face = 0.5 * tool.thickness, whole = depth + heap;
      const HeightField bed = bed_of(scene, [&](double x, double) {
        return x < 0.0 ? 0.0 : std::max(0.0, heap - std::tan(phi) * std::max(x - face, 0.0));
      });
      const double level = -0.192 * resistance(sand) * tool.width * 0.5 * whole * whole;
      problem.contenders.push_back(
          force_contender(fmt::format("heap of {:.0f} mm", 1e3 * heap), label_of(cell), scene, bed,
                          options.threads, cell, nudge(cell, depth, Eigen::Vector3d::UnitX()), 0,
                          heap > 0.0 ? std::pow(1.0 - std::sin(phi), 2) * level : level));
    }
  return problem;
}

}  // namespace sandstroke
