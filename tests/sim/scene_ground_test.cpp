#include "sim/scene_ground.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "sim/garden.h"
#include "sim/stepped_simulation.h"

namespace sandstroke {
namespace {

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

TEST(OnGround, WhatOnlyTheForceKnowsLeavesTheSandAsItIs) {
  Scene scene = small_garden();
  scene.force.law = ForceLaw::rft;
  scene.ground.regions.resize(1);
  scene.ground.regions[0].friction_angle = 35.0;
  scene.ground.layers = {{.top = -0.02, .density = 1700.0}};
  EXPECT_EQ(on_ground(starting_bed(scene.bed), scene).ground(), nullptr);
}

TEST(StrengthBlend, IsTheToolsNarrowestWidthUnlessTheSceneSaysAnother) {
  Scene scene = small_garden();
  EXPECT_DOUBLE_EQ(strength_blend(scene), 0.06);
  scene.strength.blend = 0.004;
  EXPECT_EQ(strength_blend(scene), 0.004);
}

}  // namespace
}  // namespace sandstroke
