#include "measure/contact_stiffness.h"

#include <gtest/gtest.h>

#include "sim/pressed_tool.h"

namespace sandstroke {
namespace {

TEST(ContactStiffness, IsTheLimitOverTheYieldWayAndItsGrowthForLift) {
  // F = c (d + z) (1 + z / yield) for a level plate that rises, c d being the limit: F' = limit (1 / d + 1 /
  // yield); in all other directions less.
  Scene plate = contact_scene_of(ForceLaw::archimedes, ToolShape::cylinder);
  plate.tool.radius = 0.02;
  for (const double yield : {5e-4, 2e-3})
    for (const double limit : {1.0, 4.0}) {
      plate.strength.yield_way = yield;
      const double pressure = 0.87574 * resistance(plate.strength),
                   depth = limit / (pressure * 3.14159 * 0.02 * 0.02);
      const double expected = limit * (1.0 / depth + 1.0 / yield);
      EXPECT_NEAR(contact_stiffness(plate, limit), expected, 2e-3 * expected) << yield << " " << limit;
    }
}

TEST(ContactStiffness, IsAtLeastThatOfASandThatYieldsInTheDirectionOfItsForce) {
  for (const ToolShape shape : {ToolShape::sphere, ToolShape::cone, ToolShape::plate}) {
    Scene scene = contact_scene_of(ForceLaw::rft, shape);
    const double force = 2.0, stiff = contact_stiffness(scene, force);
    // Where the tool goes on a straight way back and forth its whole force turns round within two yield ways.
    const Wrench deep = pressed(scene, 0.03).limited(force);
    EXPECT_GT(stiff, deep.force.norm() / scene.strength.yield_way);
    // A way twice as long yields half as stiffly, but for the growth with depth.
    scene.strength.yield_way *= 2.0;
    EXPECT_LT(contact_stiffness(scene, force), 0.9 * stiff);
    EXPECT_GT(contact_stiffness(scene, force), 0.45 * stiff);
  }
}

TEST(ContactStiffness, IsAboutTheSameForATurnedTool) {
  for (const ToolShape shape : {ToolShape::plate, ToolShape::cone}) {
    Scene scene = contact_scene_of(ForceLaw::rft, shape);
    scene.tool.width = 0.04;
    const double straight = contact_stiffness(scene, 3.0);
    for (const double turn : {5.0, 20.0, 90.0}) {
      scene.tool.orientation = {0.0, 0.0, turn};
      EXPECT_NEAR(contact_stiffness(scene, 3.0), straight, 0.2 * straight) << turn;
    }
  }
}

TEST(ContactStiffness, IsThatOfTheStiffestOrientationForAToolThatTurns) {
  Scene cone = contact_scene_of(ForceLaw::rft, ToolShape::cone);
  const double turning = contact_stiffness(cone, 3.0, true);
  EXPECT_GE(turning, contact_stiffness(cone, 3.0));
  cone.tool.orientation = {10.0, 20.0, 30.0};
  EXPECT_GT(turning, 0.8 * contact_stiffness(cone, 3.0));
}

}  // namespace
}  // namespace sandstroke
