// The error that sandstroke announces for a tool that few cells resolve, against runs with more cells.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/simulation.h"
#include "sim/tool_fit.h"

namespace sandstroke {
namespace {

/// The volume below the old surface [m^3] after a straight drag of that depth [m], aside by a part of a cell.
double furrow_of(ToolSettings tool, double depth, double cell, double aside) {
  Scene scene;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  tool.solid = scene.tool.solid;
  tool.profile = scene.tool.profile;
  scene.tool = tool;
  scene.bed.cols = scene.bed.rows = 2 * static_cast<int>(std::round(0.06 / cell));
  scene.bed.width = scene.bed.depth = scene.bed.cols * cell;
  scene.stroke.emplace().file = "in memory";
  Stroke stroke;
  const double y = aside * cell;
  stroke.position = {{-0.02, y, 0.005}, {-0.02, y, -depth}, {0.02, y, -depth}, {0.02, y, 0.005}};
  stroke.time = {0.0, 0.1, 0.5, 0.6};
  Simulation simulation(scene, starting_bed(scene.bed), stroke);
  simulation.run({});
  return -simulation.bed().grid().min(0.0).sum() * cell * cell;
}

TEST(CoarseTool, FurrowsAreWithinTheExpectedError) {
  ToolSettings sphere{0.005}, cylinder{0.003};
  cylinder.shape = ToolShape::cylinder;
  for (const ToolSettings& tool : {sphere, cylinder}) {
    const double depth = 0.0025, fine = furrow_of(tool, depth, tool.radius / 8.0, 0.0);
    for (const double cells : {3.0, 4.0, 6.0}) {
      double worst = 0.0;
      for (const double aside : {0.0, 0.25, 0.5})
        worst =
            std::max(worst, std::abs(furrow_of(tool, depth, 2.0 * tool.radius / cells, aside) / fine - 1.0));
      EXPECT_LT(worst, expected_furrow_error(tool.shape, cells))
          << cells << " cells of " << static_cast<int>(tool.shape);
    }
  }
}

}  // namespace
}  // namespace sandstroke
