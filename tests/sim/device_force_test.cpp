#include "sim/device_force.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sandstroke {
namespace {

/// A device whose tool moves twice as far as its handle, with 5 N at most.
Scene scaled_scene(ForceLaw law) {
  Scene scene;
  scene.force.law = law;
  scene.device.scale = 2.0;
  scene.device.max_force = 5.0;
  return scene;
}

TickRecord contact_tick() {
  TickRecord record;
  record.contact = true;
  record.depth = 0.006;
  record.wrench.force = {-3.0, 0.0, 4.0};
  record.wrench.stiffness = 300.0;
  record.wrench.stored = 0.02;
  record.wrench.strength = 10.0;
  record.wrench.whole = 8.0;
  record.wrench.given = {-1.5, 0.0, 2.0};
  record.wrench.given_stored = 0.01;
  return record;
}

TEST(DeviceForce, PapersLawGoesByDepthAndVelocity) {
  const Scene scene = scaled_scene(ForceLaw::paper);
  const SimulatedDevice device(scene.device, {});
  const auto force = make_device_force(scene);
  TickRecord record = contact_tick();
  DeviceResult result;
  const Eigen::Vector3d given = force->feel(record, device, result);
  const double repulse = 1000.0 * std::expm1(0.003);
  EXPECT_NEAR(record.repulse_force.z(), repulse, 1e-12);
  EXPECT_NEAR(given.z(), repulse, 1e-12);
  EXPECT_FALSE(record.saturated);
  const FeltSand sand = force->felt_sand(record, scene.device);
  EXPECT_NEAR(sand.stiffness, 2.0 * 500.0 * std::exp(0.003), 1e-9);
  EXPECT_NEAR(sand.drag, 2.0 * 10.0 * repulse, 1e-9);
  EXPECT_NEAR(force->stored(record, scene.device), plunge_work(0.006, 5.0, scene.force) / 2.0, 1e-15);
}

TEST(DeviceForce, OtherLawsGoByTheWrenchAndTheDevicesLimitWeakensTheSand) {
  for (const ForceLaw law : {ForceLaw::rft, ForceLaw::archimedes}) {
    const Scene scene = scaled_scene(law);
    const SimulatedDevice device(scene.device, {});
    const auto force = make_device_force(scene);
    TickRecord record = contact_tick();
    DeviceResult result;
    const Eigen::Vector3d given = force->feel(record, device, result);
    EXPECT_EQ(record.repulse_force, Eigen::Vector3d(0.0, 0.0, 4.0));
    EXPECT_EQ(record.drag_force, Eigen::Vector3d(-3.0, 0.0, 0.0));
    EXPECT_TRUE(record.saturated);  // 8 N for a device of 5
    EXPECT_EQ(given, record.wrench.given);
    const FeltSand sand = force->felt_sand(record, scene.device);
    EXPECT_NEAR(sand.stiffness, 2.0 * 150.0, 1e-9);
    EXPECT_EQ(sand.drag, 0.0);
    EXPECT_EQ(force->stored(record, scene.device), 0.01 / 2.0);
  }
}

TEST(DeviceForce, NamesTheKeysThatCalmALoop) {
  EXPECT_EQ(make_device_force(scaled_scene(ForceLaw::paper))->remedy(0.0).lower,
            std::vector<std::string>{"force.k_s"});
  EXPECT_EQ(make_device_force(scaled_scene(ForceLaw::paper))->remedy(1.0).lower,
            (std::vector<std::string>{"force.k_s", "force.k_f"}));
  EXPECT_EQ(make_device_force(scaled_scene(ForceLaw::rft))->remedy(0.0).raise, "force.yield");
}

TEST(DeviceForce, OnlyTheProgramsContactLawsDoubtTheirTheory) {
  constexpr double fast = 10.0;  // m/s
  Scene scene = scaled_scene(ForceLaw::rft);
  EXPECT_EQ(make_device_force(scene)->theory_warning(scene, 0.0), "");
  EXPECT_NE(make_device_force(scene)->theory_warning(scene, fast), "");
  scene.strength.friction_angle = 50.0;
  EXPECT_NE(make_device_force(scene)->theory_warning(scene, 0.0), "");
  scene.plugin_laws.force = "spring";
  EXPECT_EQ(make_device_force(scene)->theory_warning(scene, fast), "");
  EXPECT_EQ(make_device_force(scene)->remedy(0.0).raise, "");
  EXPECT_EQ(make_device_force(scaled_scene(ForceLaw::paper))->theory_warning(scene, fast), "");
}

}  // namespace
}  // namespace sandstroke
