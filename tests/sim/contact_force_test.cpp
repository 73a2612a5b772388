#include "sim/contact_force.h"

#include <gtest/gtest.h>

#include "sim/pressed_tool.h"

namespace sandstroke {
namespace {

TEST(ContactForce, LiftOfArchimedesActsAtTheCentroidOfWhatIsInTheSand) {
  Scene box = contact_scene_of(ForceLaw::archimedes, ToolShape::box);
  const double depth = 0.01, pressure = 0.87574 * resistance(box.strength);
  const Wrench upright = pressed(box, depth);
  EXPECT_NEAR(upright.force.z(), pressure * 0.02 * 0.02 * depth, 1e-3 * upright.force.z());
  EXPECT_LT(upright.torque.norm(), 1e-9);
  // A wall that leans over by 90 deg: its tip is at the middle of one end, and it lies along x.
  box.tool.orientation = {0.0, 90.0, 0.0};
  const Wrench lying = pressed(box, depth);
  EXPECT_NEAR(lying.force.z(), pressure * 0.04 * 0.02 * depth, 1e-3 * lying.force.z());
  EXPECT_NEAR(lying.torque.y(), -0.02 * lying.force.z(), 1e-6);
  EXPECT_NEAR(lying.torque.x(), 0.0, 1e-9);
}

TEST(ContactForce, LimitedSandIsAsMuchWeakerInEverything) {
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes}) {
    const Wrench full = pressed(contact_scene_of(law, ToolShape::cone), 0.015);
    // The parts of a force add up to no less than it.
    EXPECT_GE(full.strength, full.force.norm() * (1.0 - 1e-12));
    EXPECT_GT(full.force.norm(), 0.4 * full.strength);
    for (const double most : {0.0, 2.0 * full.strength}) EXPECT_EQ(full.limited(most).force, full.force);
    const double fraction = 0.25;
    const Wrench quarter = full.limited(fraction * full.strength);
    EXPECT_LT((quarter.force - fraction * full.force).norm(), 1e-12);
    EXPECT_LT((quarter.torque - fraction * full.torque).norm(), 1e-12);
    EXPECT_NEAR(quarter.stiffness, fraction * full.stiffness, 1e-9 * full.stiffness);
    EXPECT_NEAR(quarter.stored, fraction * full.stored, 1e-12);
    EXPECT_NEAR(quarter.strength, fraction * full.strength, 1e-12);
  }
}

}  // namespace
}  // namespace sandstroke
