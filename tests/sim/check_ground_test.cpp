#include "sim/check_ground.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/machine.h"
#include "sim/garden.h"

namespace sandstroke {
namespace {

SandRegion polygon(std::vector<Eigen::Vector2d> points) {
  SandRegion region = flat_region();
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
  scene.ground.regions = {flat_region(), polygon({{0, 0}, {1, 0}, {0, 1}})};
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
  scene.ground.regions = {flat_region(), flat_region()};
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
  scene.ground.regions = {flat_region()};
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

TEST(CheckGround, AMapNeedsAFileAndTheProgramsLaws) {
  Scene scene = small_garden();
  scene.ground.map.emplace();
  EXPECT_EQ(complaint(scene), "a.toml: sand.map.file is missing; name a map of talus angles");
  scene.ground.map->file = "talus.png";
  EXPECT_EQ(complaint(scene), "none");
  scene.plugin_laws.relaxation = "slow";
  EXPECT_EQ(
      complaint(scene),
      "a.toml: model.relaxation = \"slow\" is a plugin law, which knows no [sand.map]; remove one of the "
      "two");
}

TEST(CheckGround, AGroundMustFitTheMemory) {
  if (physical_memory() > 100e9) GTEST_SKIP() << "this machine has memory for it";
  Scene scene;
  scene.bed.cols = scene.bed.rows = 65536;
  scene.bed.width = scene.bed.depth = 131.072;
  scene.ground.floor = -0.1;
  scene.ground.regions = {flat_region()};
  scene.ground.stones = {sphere(0.0, 0.0, 0.0, 0.1)};
  EXPECT_EQ(complaint(scene), "none");
  Scene wide = scene, large = scene, bare = scene, mapped = scene;
  wide.ground.regions[0].size = {200.0, 200.0};
  large.ground.stones[0].radius = 100.0;
  bare.ground.stones.clear();
  bare.ground.floor = 0.1;                         // all sand would have to be lifted
  mapped.ground.map.emplace().file = "talus.png";  // every cell has a slope of its own
  for (const Scene& one : {wide, large, bare, mapped})
    EXPECT_NE(complaint(one).find("of memory"), std::string::npos) << complaint(one);
}

SandLayer layer(double top, double density) { return {.top = top, .density = density}; }

TEST(CheckGround, ARegionOrLayerMustSayHowItsSandDiffers) {
  Scene scene = small_garden();
  scene.ground.regions.resize(1);
  EXPECT_EQ(complaint(scene),
            "a.toml: sand.region.1 says nothing of its sand; give it a talus_angle, friction_angle, density, "
            "k_s or cohesion");
  scene.ground = {};
  scene.ground.layers.push_back({.top = -0.02});
  EXPECT_EQ(complaint(scene),
            "a.toml: sand.layer.1 says nothing of its sand; give it a friction_angle or density");
}

TEST(CheckGround, WhatTheLawOfForceDoesNotKnowIsRefused) {
  Scene scene = small_garden();
  scene.ground.regions = {flat_region()};
  scene.ground.regions[0].density = 1700.0;
  EXPECT_EQ(complaint(scene),
            "a.toml: sand.region.1.density counts only with force.law = \"rft\" or \"archimedes\"; take that "
            "law, or remove it");
  scene.force.law = ForceLaw::archimedes;
  EXPECT_EQ(complaint(scene), "none");
  scene.ground.regions[0].k_s = 500.0;
  EXPECT_EQ(complaint(scene),
            "a.toml: sand.region.1.k_s counts only with force.law = \"paper\"; take that law, or remove it");
  scene.force.law = ForceLaw::paper;
  scene.ground.regions[0].density.reset();
  EXPECT_EQ(complaint(scene), "none");
  scene.ground.layers = {layer(-0.02, 1700.0)};
  EXPECT_NE(complaint(scene).find("sand.layer.1.density counts only with"), std::string::npos);
}

TEST(CheckGround, ABlendNeedsABorder) {
  Scene scene = small_garden();
  scene.strength.blend = 0.01;
  EXPECT_EQ(
      complaint(scene),
      "a.toml: force.blend = 0.01 m counts only where a [[sand.region]] or [[sand.layer]] gives the force "
      "another sand; remove it");
  scene.ground.regions = {flat_region()};
  EXPECT_NE(complaint(scene), "none");  // its sand only rests at another angle
  scene.ground.regions[0].k_s = 500.0;
  EXPECT_EQ(complaint(scene), "none");
  scene.force.law = ForceLaw::rft;
  scene.ground.regions = {};
  scene.ground.layers = {layer(-0.02, 1700.0)};
  EXPECT_EQ(complaint(scene), "none");
}

TEST(CheckGround, ALayerLiesInTheSand) {
  Scene scene = small_garden();
  scene.force.law = ForceLaw::rft;
  scene.ground.layers = {layer(0.02, 1700.0)};  // as if depth were positive
  EXPECT_EQ(
      complaint(scene),
      "a.toml: sand.layer.1.top = 0.02 m is not below the sand, whose highest is at 0 m; z is up, so 0.02 m "
      "below level sand is -0.02");
  scene.bed.surface.kind = SurfaceKind::cone;
  scene.bed.surface.height = 0.03;
  EXPECT_EQ(complaint(scene), "none");
  scene.ground.layers = {layer(-0.02, 1700.0), layer(-0.04, 1800.0), layer(-0.02, 1600.0)};
  EXPECT_EQ(complaint(scene),
            "a.toml: sand.layer.1.top and sand.layer.3.top are both -0.02 m; change one of them");
  scene.ground.layers.pop_back();
  EXPECT_EQ(complaint(scene), "none");
  scene.ground.floor = -0.03;
  EXPECT_EQ(complaint(scene),
            "a.toml: sand.layer.2.top = -0.04 m is not above bed.floor = -0.03 m; change one of them");
}

}  // namespace
}  // namespace sandstroke
