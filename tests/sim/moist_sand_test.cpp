// Strokes through moist sand.
#include <gtest/gtest.h>

#include <cmath>

#include "rules/talus.h"
#include "sand/initial_surface.h"
#include "sim/simulation.h"
#include "sim/stepped_simulation.h"

namespace sandstroke {
namespace {

/// A sphere of 10 mm goes along x, 20 mm deep, through moist sand.
Scene moist_scene(double cohesion) {
  Scene scene;
  scene.bed.width = 0.12;
  scene.bed.depth = 0.08;
  scene.bed.cols = 96;
  scene.bed.rows = 64;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.tool.radius = 0.01;
  if (cohesion > 0.0) scene.moisture.emplace().cohesion = cohesion;
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  return scene;
}

Stroke drag() {
  Stroke stroke;
  stroke.time = {0.0, 0.2, 0.7, 0.9};
  stroke.position = {{-0.03, 0.0, 0.005}, {-0.03, 0.0, -0.02}, {0.03, 0.0, -0.02}, {0.03, 0.0, 0.02}};
  stroke.gap_threshold = 1e9;
  return stroke;
}

HeightGrid left_by(const Scene& scene, const Observers& observers = {}) {
  Simulation simulation(scene, starting_bed(scene.bed), drag());
  simulation.run(observers);
  return simulation.bed().grid();
}

/// The steepest slope across the furrow's middle, over the talus.
double steepest_of(const HeightGrid& heights, const Scene& scene) {
  const auto middle = heights.col(heights.cols() / 2);
  double steepest = 0.0;
  for (int row = 0; row + 1 < heights.rows(); ++row)
    steepest = std::max(steepest, std::abs(middle(row + 1) - middle(row)) / scene.bed.cell_size());
  return steepest / talus_slope(scene.relaxation.talus_angle);
}

TEST(MoistSand, WallsOfAFurrowStandThatSlumpInDrySand) {
  const Scene moist = moist_scene(150.0), dry = moist_scene(0.0);
  const HeightGrid stands = left_by(moist), slumps = left_by(dry);
  EXPECT_GT(steepest_of(stands, moist), 3.0);
  EXPECT_LT(steepest_of(slumps, dry), 1.01);
  EXPECT_LT(stands.minCoeff(), -0.018);
  EXPECT_GT(slumps.minCoeff(), -0.015);
}

TEST(MoistSand, FramesChangeNoBitOfTheRun) {
  struct Frames : SimulationObserver {
    int count = 0;
    void on_frame(double, const HeightField& bed) override { count += std::isfinite(bed.volume()); }
  } frames;
  Scene scene = moist_scene(150.0);
  scene.moisture->dries = 100.0;
  const HeightGrid alone = left_by(scene);
  scene.output.frames = 40.0;
  EXPECT_TRUE((left_by(scene, {&frames}) == alone).all());
  EXPECT_GT(frames.count, 30);
}

TEST(MoistSand, CopiesAndStatesGoOnWithTheSameBits) {
  Scene scene = moist_scene(150.0);
  scene.moisture->dries = 100.0;
  scene.moisture->heals = false;
  SteppedSimulation one(scene, starting_bed(scene.bed));
  const auto play = [&](SteppedSimulation& simulation, int from, int to) {
    for (int tick = from; tick < to; ++tick) {
      Hand hand;
      hand.position = {-0.03 + 6e-5 * tick, 0.0, -0.02};
      simulation.tick(hand);
    }
  };
  play(one, 0, 400);
  SteppedSimulation copy = one, other(scene, starting_bed(scene.bed));
  other.set_state(one.state());
  for (SteppedSimulation* simulation : {&one, &copy, &other}) {
    play(*simulation, 400, 800);
    simulation->lift();
    simulation->relax();
  }
  EXPECT_TRUE((copy.bed().grid() == one.bed().grid()).all());
  EXPECT_TRUE((other.bed().grid() == one.bed().grid()).all());
}

}  // namespace
}  // namespace sandstroke
