#include "sim/contact_force.h"

#include <gtest/gtest.h>

#include "sim/contact_stiffness.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

Scene scene_of(ForceLaw law, ToolShape shape) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 200;
  scene.force.law = law;
  scene.tool.shape = shape;
  return scene;
}

/// The wrench on level sand that is not displaced, after the tool has yielded downwards.
Wrench pressed(const Scene& scene, double depth) {
  HeightField bed = starting_bed(scene.bed);
  ContactForce law(scene, bed.cell_size());
  SandSide sand(scene.tool, scene.displacement);
  sand.look(bed, Vector3d::Zero());
  const Vector3d tip(0.0, 0.0, -depth - sand.footprint().lowest());
  return law.in_tick(sand, bed, tip, {0.0, 0.0, -2.0 * scene.strength.yield_way}, true);
}

TEST(ContactForce, LiftOfArchimedesActsAtTheCentroidOfWhatIsInTheSand) {
  Scene box = scene_of(ForceLaw::archimedes, ToolShape::box);
  const double depth = 0.01, share = 0.87574 * resistance(box.strength);
  const Wrench upright = pressed(box, depth);
  EXPECT_NEAR(upright.force.z(), share * 0.02 * 0.02 * depth, 1e-3 * upright.force.z());
  EXPECT_LT(upright.torque.norm(), 1e-9);
  // A wall that leans over by 90 deg: its tip is at the middle of one end, and it lies along x.
  box.tool.orientation = {0.0, 90.0, 0.0};
  const Wrench lying = pressed(box, depth);
  EXPECT_NEAR(lying.force.z(), share * 0.04 * 0.02 * depth, 1e-3 * lying.force.z());
  EXPECT_NEAR(lying.torque.y(), -0.02 * lying.force.z(), 1e-6);
  EXPECT_NEAR(lying.torque.x(), 0.0, 1e-9);
}

TEST(ContactForce, LimitedSandIsAsMuchWeakerInEverything) {
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes}) {
    const Wrench full = pressed(scene_of(law, ToolShape::cone), 0.015);
    // The parts of a force add up to no less than it.
    EXPECT_GE(full.strength, full.force.norm() * (1.0 - 1e-12));
    EXPECT_GT(full.force.norm(), 0.4 * full.strength);
    for (const double most : {0.0, 2.0 * full.strength}) EXPECT_EQ(full.limited(most).force, full.force);
    const double share = 0.25;
    const Wrench quarter = full.limited(share * full.strength);
    EXPECT_LT((quarter.force - share * full.force).norm(), 1e-12);
    EXPECT_LT((quarter.torque - share * full.torque).norm(), 1e-12);
    EXPECT_NEAR(quarter.stiffness, share * full.stiffness, 1e-9 * full.stiffness);
    EXPECT_NEAR(quarter.stored, share * full.stored, 1e-12);
    EXPECT_NEAR(quarter.strength, share * full.strength, 1e-12);
  }
}

TEST(ContactStiffness, IsTheLimitOverTheYieldWayAndItsGrowthForLift) {
  // F = c (d + z) (1 + z / yield) for a level plate that rises, c d being the limit: F' = limit (1 / d + 1 /
  // yield); in all other directions less.
  Scene plate = scene_of(ForceLaw::archimedes, ToolShape::cylinder);
  plate.tool.radius = 0.02;
  for (const double yield : {5e-4, 2e-3})
    for (const double limit : {1.0, 4.0}) {
      plate.strength.yield_way = yield;
      const double share = 0.87574 * resistance(plate.strength),
                   depth = limit / (share * 3.14159 * 0.02 * 0.02), step = std::min(0.05 * yield, 2e-5);
      const double expected = (limit - limit * (1.0 - step / depth) * (1.0 - step / yield)) / step;
      EXPECT_NEAR(contact_stiffness(plate, limit), expected, 2e-3 * expected) << yield << " " << limit;
    }
}

TEST(ContactStiffness, IsAtLeastThatOfASandThatYieldsInTheDirectionOfItsForce) {
  for (const ToolShape shape : {ToolShape::sphere, ToolShape::cone, ToolShape::plate}) {
    Scene scene = scene_of(ForceLaw::rft, shape);
    const double force = 2.0, stiff = contact_stiffness(scene, force);
    // The whole force turns round within two yield ways where the tool goes straight back and forth.
    const Wrench deep = pressed(scene, 0.03).limited(force);
    EXPECT_GT(stiff, deep.force.norm() / scene.strength.yield_way);
    // A way twice as long yields half as stiffly, but for the growth with depth and steps of 20 um.
    scene.strength.yield_way *= 2.0;
    EXPECT_LT(contact_stiffness(scene, force), 0.9 * stiff);
    EXPECT_GT(contact_stiffness(scene, force), 0.45 * stiff);
  }
}

TEST(ContactStiffness, IsAboutTheSameForATurnedTool) {
  for (const ToolShape shape : {ToolShape::plate, ToolShape::cone}) {
    Scene scene = scene_of(ForceLaw::rft, shape);
    scene.tool.width = 0.04;
    const double straight = contact_stiffness(scene, 3.0);
    for (const double turn : {5.0, 20.0, 90.0}) {
      scene.tool.orientation = {0.0, 0.0, turn};
      EXPECT_NEAR(contact_stiffness(scene, 3.0), straight, 0.2 * straight) << turn;
    }
  }
}

TEST(ContactStiffness, CoversEveryOrientationOfAToolThatTurns) {
  Scene cone = scene_of(ForceLaw::rft, ToolShape::cone);
  const double turning = contact_stiffness(cone, 3.0, true);
  EXPECT_GE(turning, contact_stiffness(cone, 3.0));
  cone.tool.orientation = {10.0, 20.0, 30.0};
  EXPECT_GT(turning, 0.8 * contact_stiffness(cone, 3.0));
}

}  // namespace
}  // namespace sandstroke
