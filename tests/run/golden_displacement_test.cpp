// The strokes of strokes/ through the sand, displaced by the engine and by the plain reference, bit for bit.
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
#include "reference/displacement_reference.h"
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

TEST_P(GoldenStroke, DisplacesAsTheReferenceDoesInEveryTick) {
  const std::filesystem::path folder = std::filesystem::path(SANDSTROKE_SOURCE) / "strokes" / GetParam();
  const Scene scene = load_scene(folder / "scene.toml", {});
  const std::filesystem::path path = folder / scene.stroke->file;
  StrokeSampler stroke(place_on_bed(
      load_stroke(path, scene.force, scene.stroke->table.value_or(TableSettings{})), scene, path.string()));

  HeightField sand(scene.bed.rows, scene.bed.cols, scene.bed.cell_size()), expected = sand;
  const auto relaxer = make_relaxer(scene.relaxation, sand.cell_size()),
             relaxer_of_expected = make_relaxer(scene.relaxation, sand.cell_size());
  ToolFootprint footprint(scene.tool);
  Eigen::Vector3d tip_before = tip_of(scene.device, stroke.at(stroke.start_time()).position);
  int pushed = 0;
  for (int tick = 0; stroke.start_time() + 1e-3 * tick <= stroke.end_time(); ++tick) {
    const Hand hand = stroke.at(stroke.start_time() + 1e-3 * tick);
    const Eigen::Vector3d tip = tip_of(scene.device, hand.position);
    const Eigen::Vector3d motion = tip - std::exchange(tip_before, tip);
    if (!hand.down) continue;
    footprint.place(sand, tip.x(), tip.y());
    const DisplacementReference reference(scene.tool, expected, tip.x(), tip.y());
    ASSERT_EQ(footprint.sand_level(), reference.sand_level(expected)) << "tick " << tick;
    const double volume = displace(sand, footprint, tip.z(), motion, scene.displacement);
    ASSERT_EQ(volume, reference.displace(expected, tip.z(), motion, scene.displacement)) << "tick " << tick;
    pushed += volume > 0.0;
    if (sanitized && pushed > 100) break;
    if (tick % 16 != 0) continue;
    if (scene.tool.solid) footprint.hold_bowl(sand), footprint.hold_bowl(expected);
    relaxer->relax(sand);
    relaxer_of_expected->relax(expected);
  }
  EXPECT_GT(pushed, 100);
  const HeightGrid a = sand.grid(), b = expected.grid();
  EXPECT_EQ(std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)), 0);
}

}  // namespace
}  // namespace sandstroke
