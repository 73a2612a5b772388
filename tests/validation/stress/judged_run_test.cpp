#include "validation/stress/judged_run.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

Scene small_scene() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.1;
  scene.bed.cols = scene.bed.rows = 10;
  return scene;
}

HeightField cliff(const Scene& scene) {
  SurfaceSettings surface;
  surface.kind = SurfaceKind::cliff;
  surface.height = 0.05;
  return make_surface(surface, scene.bed.rows, scene.bed.cols, scene.bed.cell_size());
}

TEST(JudgedRun, ComesToRest) {
  const Scene scene = small_scene();
  const JudgedRun run = judged_run(scene, cliff(scene));
  EXPECT_EQ(run.verdict, Verdict::stable) << run.reason;
  EXPECT_GT(run.result.relaxation.passes, 1);
}

TEST(JudgedRun, UsesUpItsPasses) {
  Scene scene = small_scene();
  scene.relaxation.max_passes = 1;
  const JudgedRun run = judged_run(scene, cliff(scene));
  EXPECT_EQ(run.verdict, Verdict::not_converged);
  EXPECT_NE(run.reason.find("residual"), std::string::npos) << run.reason;
}

TEST(JudgedRun, IsRefusedInASentence) {
  Scene scene = small_scene();
  scene.relaxation.law = RelaxationLaw::isotropic;
  scene.relaxation.share = 0.3;
  const JudgedRun run = judged_run(scene, cliff(scene));
  EXPECT_EQ(run.verdict, Verdict::refused);
  EXPECT_NE(run.reason.find("relaxation.share"), std::string::npos) << run.reason;
}

TEST(JudgedRun, TellsHowFarThePapersLawLeavesTheRange) {
  // A pit takes half the excess from each of its 8 sides: it is overfilled.
  const Scene scene = small_scene();
  HeightGrid heights = HeightGrid::Zero(10, 10);
  heights(5, 5) = -0.015;
  const JudgedRun run = judged_run(scene, HeightField(heights, scene.bed.cell_size()));
  EXPECT_EQ(run.verdict, Verdict::stable) << run.reason;
  EXPECT_GT(run.overshoot, 0.0);
}

TEST(JudgedRun, LaysTheBedOnItsGroundAndLooksBelowItsFloor) {
  Scene scene = small_scene();
  scene.ground.floor = 0.02;
  const JudgedRun run = judged_run(scene, cliff(scene));
  EXPECT_EQ(run.verdict, Verdict::stable) << run.reason;
  EXPECT_GT(run.result.volume_initial, 0.05 * 0.1 * 0.05 + 0.9 * 0.02 * 0.1 * 0.05);  // lifted onto the floor
}

TEST(JudgedRun, DoesNotTakePouredSandForLostOrOutOfRange) {
  Scene scene = small_scene();
  SourceSettings& source = scene.sources.emplace_back();
  source.rate = 0.5;
  source.stop = 0.2;
  const JudgedRun run = judged_run(scene, HeightField(10, 10, 0.01));
  EXPECT_EQ(run.verdict, Verdict::stable) << run.reason;
  EXPECT_GT(run.result.given_volume, 0.0);
}

TEST(JudgedRun, HasTheSameBitsForTheSameSceneAndOthersForAnother) {
  Scene scene = small_scene();
  const JudgedRun run = judged_run(scene, cliff(scene)), threads = judged_on_threads(scene, cliff(scene));
  EXPECT_EQ(threads.verdict, Verdict::stable) << threads.reason;
  EXPECT_EQ(run.bits, threads.bits);
  scene.relaxation.talus_angle = 31.0;
  EXPECT_NE(judged_run(scene, cliff(scene)).bits, run.bits);
}

TEST(Variations, NamesTheFirstThatSurprised) {
  JudgedRun rests, loses;
  rests.verdict = Verdict::stable;
  loses.reason = "2 m^3 are lost";
  Variations all("group", "name", "settings", {Verdict::stable});
  all.add(rests, "cells of 1 m");
  EXPECT_EQ(all.done().verdict, Verdict::stable);
  EXPECT_FALSE(all.done().surprise());
  all.add(loses, "cells of 2 m");
  all.add(loses, "cells of 3 m");
  const StressCase done = all.done();
  EXPECT_TRUE(done.surprise());
  EXPECT_EQ(done.detail, "cells of 2 m: broken 2 m^3 are lost (1 stable, 2 broken)");
}

TEST(Variations, ShowsTheVerdictMetMostAndARefusalsSentence) {
  JudgedRun rests, refused;
  rests.verdict = Verdict::stable;
  refused.verdict = Verdict::refused;
  refused.reason = "take less";
  Variations all("group", "name", "settings", {Verdict::stable, Verdict::refused});
  all.add(rests, "a");
  all.add(refused, "b");
  all.add(refused, "c");
  EXPECT_EQ(all.done().verdict, Verdict::refused);
  EXPECT_EQ(all.done().detail, "1 stable, 2 refused; take less");
}

}  // namespace
}  // namespace sandstroke
