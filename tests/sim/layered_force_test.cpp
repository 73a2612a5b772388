// The force of sand that is not the same everywhere, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/device_force.h"
#include "sim/pressed_tool.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr double lift = 0.87574;  // of a plate, by the theory, at tan(phi) = tan(30 deg) as elsewhere

/// A level plate of 40 mm x 40 mm in two layers.
Scene plate_on_layers(ForceLaw law) {
  Scene scene = contact_scene_of(law, ToolShape::box);
  scene.tool.size = {0.04, 0.04, 0.1};
  scene.strength.blend = 0.01;
  scene.ground.layers = {{.top = -0.02, .friction_angle = 36.0, .density = 1750.0}};
  return scene;
}

SandStrength lower_sand() { return {.friction_angle = 36.0, .density = 1750.0}; }

TEST(LayeredForce, OnAPlateIsTheLowerSandsFrictionUnderTheWeightOfBoth) {
  const Scene scene = plate_on_layers(ForceLaw::archimedes);
  const SandStrength &upper = scene.strength, lower = lower_sand();
  const double area = 0.04 * 0.04;
  for (const double depth : {0.005, 0.01, 0.014})
    EXPECT_NEAR(pressed(scene, depth).force.z(), lift * area * resistance(upper) * depth, 1e-9);
  for (const double depth : {0.026, 0.03, 0.05}) {
    const double exact = lift * area * (resistance(lower) / lower.density) *
                         (upper.density * 0.02 + lower.density * (depth - 0.02));
    EXPECT_NEAR(pressed(scene, depth).force.z(), exact, 1e-9 * exact) << depth;
  }
}

TEST(LayeredForce, StepsNowhere) {
  // Across the border the force goes over within the blend, and grows by no more than its stiffness says.
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes}) {
    const Scene scene = plate_on_layers(law);
    double before = pressed(scene, 0.010).force.norm();
    constexpr double step = 1e-4;
    for (int i = 1; i <= 200; ++i) {
      const Wrench felt = pressed(scene, 0.010 + i * step);
      EXPECT_LE(std::abs(felt.force.norm() - before), 1.01 * felt.stiffness * step) << i;
      before = felt.force.norm();
    }
  }
}

TEST(LayeredForce, InARegionIsThatOfItsSand) {
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes})
    for (const ToolShape shape : {ToolShape::box, ToolShape::sphere}) {
      const Scene own = contact_scene_of(law, shape);
      Scene beside = own, within = own, other = own;
      other.strength.friction_angle = 36.0;
      other.strength.density = 1750.0;
      SandRegion region;
      region.friction_angle = 36.0;
      region.density = 1750.0;
      region.centre = {0.5, 0.0};  // its edge is at x = 0.25
      beside.ground.regions = {region};
      region.centre = {0.0, 0.0};
      within.ground.regions = {region};
      const double depth = 0.012, plain = pressed(own, depth).force.z();
      // A sphere's elements stand for the formula of its volume.
      EXPECT_NEAR(pressed(beside, depth).force.z(), plain, 5e-3 * plain);
      EXPECT_NEAR(pressed(within, depth).force.z() / pressed(beside, depth).force.z(),
                  resistance(other.strength) / resistance(own.strength), 1e-9);
    }
}

TEST(LayeredForce, OnTheSameSandHasTheBitsOfNoLayer) {
  const Scene own = contact_scene_of(ForceLaw::rft, ToolShape::cone);
  Scene same = own;
  same.ground.layers = {
      {.top = -0.005, .friction_angle = own.strength.friction_angle, .density = own.strength.density}};
  same.ground.regions.resize(1);
  same.ground.regions[0].size = {0.01, 0.01};
  same.ground.regions[0].density = own.strength.density;
  const Wrench a = pressed(own, 0.012), b = pressed(same, 0.012);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_EQ(a.stiffness, b.stiffness);
}

TEST(LayeredForce, OfClosedPathsAcrossABorderGivesNoEnergy) {
  // Down through a border to harder or softer sand, along it, and up again, around a border of regions, too.
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes})
    for (const double lower : {20.0, 42.0}) {
      Scene scene = plate_on_layers(law);
      scene.ground.layers[0].friction_angle = lower;
      scene.ground.regions.resize(1);
      scene.ground.regions[0].centre = {0.25, 0.0};
      scene.ground.regions[0].friction_angle = 60.0 - lower;
      HeightField bed = starting_bed(scene.bed);
      const std::unique_ptr<ToolForce> force = make_contact_force(scene, bed.cell_size());
      SandSide sand(scene.tool, scene.displacement);
      sand.look(bed, Vector3d::Zero());
      Vector3d tip(0.0, 0.0, 0.0);
      double work = 0.0, least = 0.0;
      Wrench felt;
      const auto go = [&](const Vector3d& to) {
        felt = force->in_tick(sand, bed, to, to - tip, true);
        work -= felt.force.dot(to - tip);
        tip = to;
        least = std::min(least, work);
      };
      for (int i = 1; i <= 200; ++i) go({0.0, 0.0, -0.02 * i / 200});
      for (int turn = 0; turn < 5; ++turn) {
        const double before = work, stored = felt.stored;
        for (int i = 1; i <= 2000; ++i) {
          const double angle = 2.0 * std::numbers::pi * i / 2000;
          go({0.02 * std::sin(angle), 0.0, -0.02 + 0.015 * std::sin(2.0 * angle)});
        }
        EXPECT_GE(work - before, felt.stored - stored - 1e-9 * work);
      }
      EXPECT_GE(least, 0.0);
    }
}

TEST(LayeredForce, OfThePapersLawTakesTheRegionsConstant) {
  Scene scene;
  scene.device.scale = 2.0;
  scene.device.offset = {0.1, 0.0, 0.0};
  scene.tool.radius = 0.05;
  scene.ground.regions.resize(1);
  SandRegion& region = scene.ground.regions[0];
  region.centre = {0.5, 0.0};
  region.size = {0.4, 0.4};  // from x = 0.3 on
  region.k_s = 3000.0;
  scene.device.max_force = 0.0;
  const SimulatedDevice device(scene.device, {});
  const std::unique_ptr<DeviceForce> law = make_device_force(scene);
  const auto at = [&](double x) {
    TickRecord tick;
    tick.contact = true;
    tick.depth = 0.01;
    tick.device_position = Vector3d(0.5 * (x - 0.1), 0.0, 0.0);
    DeviceResult result;
    law->feel(tick, device, result);
    EXPECT_NEAR(law->felt_sand(tick, scene.device).stiffness / tick.repulse_force.z(),
                scene.device.scale * 0.5 * std::exp(0.005) / std::expm1(0.005), 1e-6);
    return tick.repulse_force.z();
  };
  const double own = 1000.0 * std::expm1(0.005);
  EXPECT_NEAR(at(0.24), own, 1e-9);
  EXPECT_NEAR(at(0.36), 3.0 * own, 1e-9);
  EXPECT_NEAR(at(0.30), 2.0 * own, 1e-9);  // over a tool's width, 0.1 m
}

}  // namespace
}  // namespace sandstroke
