// What is shown of a bed between two relaxations: sand at rest.
#include "sim/sand_at_rest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/simulation.h"

namespace sandstroke {
namespace {

/// A deep plate that goes along x.
Scene deep_scene(ToolShape shape) {
  Scene scene;
  scene.bed.width = 0.2;
  scene.bed.depth = 0.12;
  scene.bed.cols = 100;
  scene.bed.rows = 60;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.tool.shape = shape;
  scene.tool.width = 0.05;
  scene.tool.thickness = 0.01;
  scene.tool.height = 0.04;
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  return scene;
}

Stroke deep_stroke() {
  Stroke stroke;
  stroke.time = {0.0, 0.3, 0.9, 1.0};
  stroke.position = {{-0.05, 0.0, 0.005}, {-0.05, 0.0, -0.015}, {0.04, 0.0, -0.015}, {0.04, 0.0, 0.02}};
  stroke.gap_threshold = 1e9;
  return stroke;
}

/// The highest sand [m] and the volume [m^3] of each frame, and the highest sand after each relaxation.
struct Shown : SimulationObserver {
  explicit Shown(const Simulation& simulation) : of(simulation) {}
  const Simulation& of;
  struct Frame {
    double highest, volume, highest_pushed;
    std::size_t relaxations;  // before it
  };
  std::vector<Frame> frames;
  std::vector<double> relaxed;
  void on_relaxation(const RelaxationRecord&) override { relaxed.push_back(of.bed().highest()); }
  void on_frame(double, const HeightField& bed) override {
    frames.push_back({bed.highest(), bed.volume(), of.bed().highest(), relaxed.size()});
  }
};

TEST(SandAtRest, IsWhatFramesShow) {
  for (const ToolShape shape : {ToolShape::sphere, ToolShape::plate}) {
    Scene scene = deep_scene(shape);
    Simulation alone(scene, starting_bed(scene.bed), deep_stroke());
    const RunResult without = alone.run();
    scene.output.frames = 50.0;
    Simulation shown(scene, starting_bed(scene.bed), deep_stroke());
    Shown seen(shown);
    const RunResult with = shown.run({&seen});
    // Who looks changes nothing.
    EXPECT_TRUE((alone.bed().grid() == shown.bed().grid()).all());
    EXPECT_EQ(without.relaxations, with.relaxations);
    EXPECT_EQ(without.relaxation.passes, with.relaxation.passes);
    double most_pushed = 0.0, most_shown = 0.0;
    ASSERT_GT(seen.frames.size(), 40u);
    for (const Shown::Frame& frame : seen.frames) {
      EXPECT_NEAR(frame.volume, with.volume_initial, 1e-12 * with.moved_volume);
      most_pushed = std::max(most_pushed, frame.highest_pushed);
      most_shown = std::max(most_shown, frame.highest);
      if (frame.relaxations == 0 || frame.relaxations == seen.relaxed.size()) continue;
      const double relaxed = std::max(seen.relaxed[frame.relaxations - 1], seen.relaxed[frame.relaxations]);
      EXPECT_LE(frame.highest, 1.3 * relaxed) << frame.relaxations;
    }
    EXPECT_GT(most_pushed, 1.5 * most_shown) << "or this shows nothing";
  }
}

TEST(SandAtRest, TakesOverWhatDiffersAndNothingElse) {
  const Scene scene = deep_scene(ToolShape::sphere);
  HeightField bed = starting_bed(scene.bed);
  bed.set(10, 10, 0.0002);
  SandAtRest at_rest(bed, make_relaxer(scene.relaxation, bed.cell_size()));
  at_rest.follow(bed);
  at_rest.relax();
  EXPECT_TRUE((at_rest.copy().grid() == bed.grid()).all());
  bed.set(40, 80, 0.02);  // a spike
  at_rest.follow(bed);
  at_rest.relax();
  const HeightField& shown = at_rest.copy();
  EXPECT_LT(shown(40, 80), 0.01);
  EXPECT_EQ(shown(10, 10), 0.0002);
  EXPECT_EQ(bed(40, 80), 0.02);
  EXPECT_NEAR(shown.volume(), bed.volume(), 1e-18);
  bed.set(40, 80, 0.0);  // and none: what flowed from it is gone
  at_rest.follow(bed);
  at_rest.relax();
  EXPECT_TRUE((at_rest.copy().grid() == bed.grid()).all());
}

}  // namespace
}  // namespace sandstroke
