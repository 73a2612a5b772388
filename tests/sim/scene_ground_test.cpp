#include "sim/scene_ground.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "core/machine.h"
#include "sim/stepped_simulation.h"

namespace sandstroke {
namespace {

/// 1 m x 1 m in cells of 1 cm, without a ground.
Scene small_garden() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 1.0;
  scene.bed.cols = scene.bed.rows = 100;
  scene.tool.radius = 0.03;
  return scene;
}

StoneSettings sphere(double x, double y, double z, double radius) {
  StoneSettings stone;
  stone.centre = {x, y, z};
  stone.radius = radius;
  return stone;
}

SandRegion polygon(std::vector<Eigen::Vector2d> points) {
  SandRegion region;
  region.shape = RegionShape::polygon;
  region.points = std::move(points);
  return region;
}

std::string complaint(const Scene& scene) {
  try {
    check_scene(scene, "a.toml");
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "none";
}

TEST(CheckGround, TakesAGarden) {
  Scene scene = small_garden();
  scene.ground.floor = -0.1;
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 0.1), sphere(0.49, 0.0, 0.0, 0.1)};
  scene.ground.regions = {SandRegion(), polygon({{0, 0}, {1, 0}, {0, 1}})};
  EXPECT_EQ(complaint(scene), "none");
}

TEST(CheckGround, WhatCannotBeSeenIsRefused) {
  Scene scene = small_garden();
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 0.1), sphere(0.61, 0.0, 0.0, 0.1)};
  EXPECT_EQ(complaint(scene),
            "a.toml: stone.2 lies outside the bed of 1 m by 1 m; change stone.2.centre, or remove it");
  scene.ground.stones = {sphere(0.0, 0.0, -0.5, 0.25)};
  EXPECT_EQ(complaint(scene), "none");  // a tool may get there
  scene.ground.floor = -0.25;
  EXPECT_EQ(
      complaint(scene),
      "a.toml: stone.1 ends at z = -0.25 m, and bed.floor = -0.25 m is not below that; raise the stone, or "
      "remove it");
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 0.1), sphere(0.1, 0.0, 0.0, 0.1), sphere(0.0, 0.0, 0.0, 0.1)};
  EXPECT_EQ(complaint(scene), "a.toml: stone.3 is the same as stone.1; remove one of them");
  scene.ground = {};
  scene.ground.regions.resize(2);
  EXPECT_EQ(complaint(scene), "a.toml: sand.region.2 is the same as sand.region.1; remove one of them");
  scene.ground.regions[1].centre = {0.0, -0.76};
  EXPECT_EQ(
      complaint(scene),
      "a.toml: sand.region.2 lies outside the bed of 1 m by 1 m; change sand.region.2.centre, or remove it");
  scene.ground.regions[1].soft = 0.04;  // its band reaches the bed
  EXPECT_EQ(complaint(scene), "none");
}

TEST(CheckGround, PolygonsNeedAnOutline) {
  Scene scene = small_garden();
  scene.ground.regions = {polygon({{0, 0}, {1, 0}, {0, 0}, {1, 0}})};
  EXPECT_EQ(complaint(scene), "a.toml: sand.region.1.points has 2 different corners; give 3 or more");
  scene.ground.regions = {polygon({{0, 0}, {0.1, 0.1}, {0.1, 0}, {0, 0.1}})};
  EXPECT_EQ(
      complaint(scene),
      "a.toml: sand.region.1.points has edges that cross; give the corners in order around the outline");
}

TEST(CheckGround, NoLengthIsTooLargeToReckonWith) {
  Scene scene = small_garden();
  scene.ground.stones = {sphere(0.0, 0.0, 1001.0, 0.1)};
  EXPECT_EQ(complaint(scene), "a.toml: stone.1.centre has 1001 m; give 1000 m or less");
  scene.ground.stones = {sphere(0.0, 1e308, 0.0, 0.1)};
  EXPECT_NE(complaint(scene).find("stone.1.centre"), std::string::npos);
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 1e308)};
  EXPECT_NE(complaint(scene).find("stone.1.radius"), std::string::npos);
  scene.ground = {};
  scene.ground.regions = {polygon({{0, 0}, {1e300, 0}, {0, 1}})};
  EXPECT_NE(complaint(scene).find("sand.region.1.points"), std::string::npos);
}

TEST(CheckGround, SomeLawsKnowNoFloor) {
  Scene scene = small_garden();
  scene.relaxation.law = RelaxationLaw::paper;
  scene.relaxation.method = RelaxationMethod::rkl;
  scene.ground.regions.resize(1);
  EXPECT_EQ(complaint(scene), "none");
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 0.1)};
  EXPECT_EQ(complaint(scene),
            "a.toml: relaxation.law = \"paper\" goes with relaxation.method = \"passes\" or \"plain\" where "
            "there is a [[stone]]; take one of them, or another law");
  for (const RelaxationMethod method : {RelaxationMethod::passes, RelaxationMethod::plain}) {
    scene.relaxation.method = method;
    EXPECT_EQ(complaint(scene), "none");
  }
  scene.plugin_laws.force = "spring";
  EXPECT_EQ(
      complaint(scene),
      "a.toml: model.force = \"spring\" is a plugin law, which knows no [[stone]]; remove one of the two");
}

TEST(CheckGround, AGroundMustFitTheMemory) {
  if (physical_memory() > 100e9) GTEST_SKIP() << "this machine has memory for it";
  Scene scene;
  scene.bed.cols = scene.bed.rows = 65536;
  scene.bed.width = scene.bed.depth = 131.072;
  scene.ground.floor = -0.1;
  scene.ground.regions.resize(1);
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 0.1)};
  EXPECT_EQ(complaint(scene), "none");
  Scene wide = scene, large = scene, bare = scene;
  wide.ground.regions[0].size = {200.0, 200.0};
  large.ground.stones[0].radius = 100.0;
  bare.ground.stones.clear();
  bare.ground.floor = 0.1;  // all sand would have to be lifted
  for (const Scene& one : {wide, large, bare})
    EXPECT_NE(complaint(one).find("of memory"), std::string::npos) << complaint(one);
}

TEST(OnGround, ASceneWithoutAGroundChangesNothing) {
  const Scene scene = small_garden();
  const HeightField bed = on_ground(starting_bed(scene.bed), scene);
  EXPECT_EQ(bed.ground(), nullptr);
  EXPECT_EQ(bed.allocated_tiles(), 0);
}

TEST(OnGround, SandIsLiftedOntoAStoneAndFollowsIt) {
  Scene scene = small_garden();
  scene.ground.floor = -0.05;
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 0.1)};
  scene.ground.regions.resize(1);
  scene.ground.regions[0].talus_angle = 40.0;
  const HeightField bed = on_ground(starting_bed(scene.bed), scene);
  ASSERT_NE(bed.ground(), nullptr);
  EXPECT_EQ(bed(50, 50), bed.floor(50, 50));
  EXPECT_GT(bed(50, 50), 0.099);
  EXPECT_EQ(bed(0, 0), 0.0);
  EXPECT_EQ(bed.floor(0, 0), -0.05);
  for (int row = 0; row < 100; ++row)
    for (int col = 0; col < 100; ++col) ASSERT_GE(bed(row, col), bed.floor(row, col));
  const HeightField copy = bed;
  EXPECT_EQ(copy.ground(), bed.ground());
  EXPECT_NE(content_hash(copy), content_hash(starting_bed(scene.bed)));
}

TEST(OnGround, WithoutAFloorSandIsDeepBesideAStone) {
  Scene scene = small_garden();
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 0.1)};
  const HeightField bed = on_ground(starting_bed(scene.bed), scene);
  EXPECT_EQ(bed.floor(0, 0), -std::numeric_limits<double>::infinity());
}

TEST(OnGround, AHugeBedOnAFloorAllocatesNothing) {
  Scene scene;
  scene.bed.cols = scene.bed.rows = 65536;
  scene.ground.floor = -0.1;
  EXPECT_EQ(on_ground(starting_bed(scene.bed), scene).allocated_tiles(), 0);
}

TEST(OnGround, AStateIsOfItsGround) {
  Scene scene = small_garden();
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 0.1)};
  Scene other = scene;
  other.ground.stones[0].radius = 0.11;
  SteppedSimulation one(scene, on_ground(starting_bed(scene.bed), scene));
  SteppedSimulation same(scene, on_ground(starting_bed(scene.bed), scene));
  SteppedSimulation another(other, on_ground(starting_bed(other.bed), other));
  const std::string state = one.state();
  EXPECT_NO_THROW(same.set_state(state));
  EXPECT_THROW(another.set_state(state), Error);
}

}  // namespace
}  // namespace sandstroke
