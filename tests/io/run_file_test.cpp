#include "io/run_file.h"

#include <gtest/gtest.h>

#include <optional>

#include "io/run_writer.h"
#include "sim/simulation.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

/// The last surface of a run whose sand rose by 1 cm in each frame (0.25 s), and by another before it ended.
LastSurface left_by(int frames, bool interrupted) {
  const TestFolder folder;
  const std::filesystem::path file = folder / "run.h5";
  Scene scene;
  scene.bed.width = scene.bed.depth = 1.0;
  scene.bed.rows = scene.bed.cols = 100;
  const Simulation simulation(scene, starting_bed(scene.bed), std::nullopt);
  std::optional<RunWriter> writer(std::in_place, file, simulation, ViewSettings{}, "");
  HeightField bed = simulation.bed();
  double height = 0.0;
  for (int frame = 0; frame < frames; ++frame) {
    bed.set(70, 3 * frame, height += 0.01);
    writer->on_frame(0.25 * frame, bed);
  }
  bed.set(10, 20, height += 0.01);
  RunResult result;
  result.interrupted = interrupted;
  writer->end(result, bed);
  if (!result.interrupted) writer->finish();
  writer.reset();
  return last_surface(RunFile(interrupted ? file.string() + ".part" : file.string()));
}

TEST(LastSurface, IsTheFinalOneOfAWholeRun) {
  const LastSurface last = left_by(3, false);
  EXPECT_EQ(last.name, "final surface");
  EXPECT_EQ(last.surface(10, 20), 0.04);
  EXPECT_EQ(last.surface(70, 6), 0.03);
}

TEST(LastSurface, IsThatOfTheLastFrameWhereTheRunWasCutOff) {
  const LastSurface last = left_by(3, true);
  EXPECT_EQ(last.name, "surface at 0.5 s");
  EXPECT_EQ(last.surface(10, 20), 0.0);
  EXPECT_EQ(last.surface(70, 0), 0.01);
  EXPECT_EQ(last.surface(70, 6), 0.03);
}

TEST(LastSurface, IsTheInitialOneWhereThereAreNoFrames) {
  const LastSurface last = left_by(0, true);
  EXPECT_EQ(last.name, "initial surface");
  EXPECT_EQ(last.surface.highest(), 0.0);
}

}  // namespace
}  // namespace sandstroke
