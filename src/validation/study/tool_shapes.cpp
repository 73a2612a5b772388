// Tools of any shape. Compares their heaps with closed forms, and a sphere given as a mesh with the sphere.
#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "sim/simulation.h"
#include "tool/tool_surface.h"
#include "validation/study/contact_scene.h"
#include "validation/study/hand_strokes.h"
#include "validation/study/stroke_replay.h"

namespace sandstroke {
namespace {

/// A bed along x, `rows` cells across, for a tool that reaches from side to side. The sand is the same in
/// every row.
Scene trough(double length, double cell, int rows, const ToolSettings& tool) {
  Scene scene = contact_scene(length, static_cast<int>(std::lround(length / cell)), 1000.0);
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.bed.rows = rows;
  scene.bed.depth = rows * scene.bed.cell_size();
  scene.tool = tool;
  scene.tool.solid = true;
  return scene;
}

/// Keeps the height of the highest sand in the last frame [m].
class HighestSand : public SimulationObserver {
 public:
  void on_frame(double, const HeightField& bed) override { height = bed.grid().maxCoeff(); }
  double height = 0.0;
};

enum class Measured { tool_in_sand, tool_gone };

/// A run that should heap sand up to the height `exact` [m], either while the tool supports the heap or after
/// the tool left and the sand relaxed. Relaxation is as frequent as possible, every quarter of a cell,
/// because the closed form assumes sand at rest.
Contender heap_contender(const std::string& series, Scene scene, int threads, const Stroke& stroke,
                         Measured when, double exact) {
  scene.relaxation.way = scene.relaxation.way_at_rim = 1e-3;
  if (when == Measured::tool_in_sand) scene.output.frames = 100.0;
  return {series, fmt::format("cells of {:.3g} mm", 1e3 * scene.bed.cell_size()), settings_of(scene, threads),
          scene.bed.cell_size(), [=] {
            HighestSand in_the_end;
            const Solution run = solve(scene, starting_bed(scene.bed), stroke, {&in_the_end});
            const double height =
                when == Measured::tool_in_sand ? in_the_end.height : run.surface.grid().maxCoeff();
            Trial trial{run.result.wall_seconds, score_of(run.result)};
            trial.score.largest_height = std::abs(height - exact);
            trial.score.largest_relative = trial.score.largest_height / exact;
            return trial;
          }};
}

Problem heap_problem(const char* name, const char* title, const char* text) {
  return {name, title, text, "largest_relative", "height of the heap, relative error", "", {}};
}

/// A wedge along y with its edge below and flanks of this slope. It is so long that displaced sand leaves
/// over the flanks, and so wide that it comes to lie clear of them.
ToolSettings wedge(double flank) {
  constexpr double half_width = 0.04, half_length = 0.045;  // m
  auto mesh = std::make_shared<TriangleMesh>();
  for (const double y : {-half_length, half_length})
    for (const double x : {0.0, half_width, -half_width})
      mesh->vertices.emplace_back(x, y, flank * std::abs(x));
  mesh->triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}};
  ToolSettings tool;
  tool.shape = ToolShape::mesh;
  tool.mesh = mesh;
  return tool;
}

}  // namespace

Problem blade_problem(const ProblemOptions& options) {
  Problem problem =
      heap_problem("blade", "Heap of a blade",
                   "A blade d deep moves s along a trough. The displaced sand, d s, lies before it as a "
                   "wedge of the talus slope t. Its height is the square root of 2 t d s.");
  constexpr double depth = 0.004, way = 0.12, from = -0.1, speed = 0.1;  // m, m/s
  for (const double cell : {0.004, 0.002, 0.001, 0.0005}) {
    if (options.quick && cell < 0.001) continue;
    ToolSettings blade;
    blade.shape = ToolShape::plate;
    blade.width = 1.0;
    blade.height = 0.1;
    blade.thickness = 0.004;
    const Scene scene = trough(0.3, cell, 10, blade);
    const double slope = talus_slope(scene.relaxation.talus_angle);
    const Stroke stroke =
        straight({{from, 0.0, 0.0}, {from, 0.0, -depth}, {from + way, 0.0, -depth}}, {0.1, way / speed});
    problem.contenders.push_back(heap_contender("cell size", scene, options.threads, stroke,
                                                Measured::tool_in_sand,
                                                std::sqrt(2.0 * slope * depth * way)));
  }
  return problem;
}

Problem wedge_problem(const ProblemOptions& options) {
  Problem problem =
      heap_problem("wedge", "Levees of a wedge",
                   "A wedge of flanks f is pressed d deep into the sand. On each side d² / (2 f) of sand "
                   "lies as a levee of the talus slope t both ways: its height is d times the square root of "
                   "t / (2 f). That holds where it all comes to lie in one place: pressed slowly, the wedge "
                   "puts sand farther and farther out, and its levees are wider and lower.");
  constexpr double depth = 0.01, flank = 0.4;  // m
  for (const bool at_once : {true, false})
    for (const double cell : {0.002, 0.001, 0.0005, 0.00025}) {
      if (options.quick && (cell < 0.0005 || !at_once)) continue;
      const Scene scene = trough(0.24, cell, 12, wedge(flank));
      const double slope = talus_slope(scene.relaxation.talus_angle);
      const Stroke stroke = straight({{0.0, 0.0, 0.001}, {0.0, 0.0, -depth}}, {at_once ? 0.001 : 1.0});
      // Heights are means over a cell. The crest lies in the middle of its cell.
      const double height = depth * std::sqrt(slope / (2.0 * flank)) - 0.25 * slope * cell;
      Contender contender = heap_contender(at_once ? "at once" : "slowly", scene, options.threads, stroke,
                                           Measured::tool_gone, height);
      if (!at_once) contender.step = not_applicable;
      problem.contenders.push_back(std::move(contender));
    }
  return problem;
}

Problem mesh_problem(const ProblemOptions& options) {
  Problem problem{"mesh",
                  "A sphere given as a mesh",
                  "A curved stroke 4 mm deep, accurate preset, with the sphere as triangles; in place of the "
                  "truth stands the same stroke with the sphere itself, on the same cells.",
                  "l1",
                  "sand that lies elsewhere, of the sand that moves",
                  "",
                  {}};
  const Stroke stroke = s_curve(0.004, 0.25, options.quick);
  for (const int cells_per_radius : {5, 10, 20}) {
    if (options.quick && cells_per_radius > 10) continue;
    Scene sphere = hand_scene(ModelPreset::accurate);
    const int by = cells_per_radius / 5;
    sphere.bed.cols *= by;
    sphere.bed.rows *= by;
    sphere.relaxation.way = sphere.relaxation.way_at_rim = 0.2;  // a mesh always relaxes by way_at_rim
    Scene mesh = sphere;
    mesh.tool.shape = ToolShape::mesh;
    mesh.tool.mesh = std::make_shared<TriangleMesh>(tool_surface(sphere.tool));
    problem.contenders.push_back(stroke_contender(
        "cell size", fmt::format("{} cells per radius", cells_per_radius), mesh, options.threads,
        mesh.bed.cell_size(), stroke, std::make_shared<const Replay>(replay(sphere, stroke))));
  }
  return problem;
}

}  // namespace sandstroke
