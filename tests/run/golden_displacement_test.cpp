// The strokes of strokes/ through the sand, displaced by the engine and by the plain rule, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <utility>

#include "haptics/simulated_device.h"
#include "haptics/stroke_placement.h"
#include "haptics/stroke_sampler.h"
#include "io/scene_toml.h"
#include "io/stroke_file.h"
#include "rules/displacement.h"
#include "sand/relaxation.h"
#include "sand/sphere_tool.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

class GoldenStroke : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, GoldenStroke, testing::Values("wscg", "depths-ahead", "depths-solid"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(GoldenStroke, DisplacesAsThePlainRuleDoesInEveryTick) {
  const std::filesystem::path folder = std::filesystem::path(SANDSTROKE_SOURCE) / "strokes" / GetParam();
  const Scene scene = load_scene(folder / "scene.toml", {});
  const std::filesystem::path path = folder / scene.stroke->file;
  StrokeSampler stroke(place_on_bed(
      load_stroke(path, scene.force, scene.stroke->table.value_or(TableSettings{})), scene, path.string()));

  HeightField sand(scene.bed.rows, scene.bed.cols, scene.bed.cell_size());
  HeightGrid expected = sand.grid();
  const WallGrid no_walls = WallGrid::Zero(sand.rows(), sand.cols());
  const auto relaxer = make_relaxer(scene.relaxation, sand.cell_size());
  SphereTool tool(scene.tool);
  Eigen::Vector3d tip_before = tip_of(scene.device, stroke.at(stroke.start_time()).position);
  int pushed = 0;
  for (int tick = 0; stroke.start_time() + 1e-3 * tick <= stroke.end_time(); ++tick) {
    const Hand hand = stroke.at(stroke.start_time() + 1e-3 * tick);
    const Eigen::Vector3d tip = tip_of(scene.device, hand.position);
    const Eigen::Vector3d motion = tip - std::exchange(tip_before, tip);
    if (!hand.down) continue;
    tool.place(sand, tip.x(), tip.y());
    const PlainDisplacement plain(scene.tool.profile, scene.tool.radius, no_walls, sand.cell_size(), tip.x(),
                                  tip.y());
    ASSERT_EQ(tool.sand_level(), plain.sand_level(expected)) << "tick " << tick;
    const double volume = tool.displace(sand, tip.z(), motion, scene.displacement);
    ASSERT_EQ(volume, plain.displace(expected, tip.z(), motion, scene.displacement)) << "tick " << tick;
    pushed += volume > 0.0;
    if (sanitized && pushed > 100) break;
    if (tick % 16 != 0) continue;
    const HeightGrid displaced = sand.grid();
    ASSERT_EQ(std::memcmp(displaced.data(), expected.data(), sizeof(double) * expected.size()), 0) << tick;
    if (scene.tool.solid) tool.make_walls(sand);
    relaxer->relax(sand);
    expected = sand.grid();
  }
  EXPECT_GT(pushed, 100);
}

}  // namespace
}  // namespace sandstroke
