#include "haptics/sand_force.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

const SimulatedDevice::State moving{{0.0, 0.0, -0.003}, {0.1, -0.2, 0.05}};
const SimulatedDevice::State hand{{0.0, 0.0, -0.01}, {0.1, 0.0, 0.0}},
    hand_after{{1e-4, 0.0, -0.01}, {0.1, 0.0, 0.0}};

SimulatedDevice device_with(DragVelocity drag, DeviceModel model = DeviceModel::dynamic) {
  DeviceSettings settings = ideal_device();
  settings.model = model;
  settings.scale = 2.0;
  settings.drag = drag;
  return SimulatedDevice(settings, moving);
}

TEST(ForceOnDevice, SampledDragIsByTheVelocityReadInBedMetres) {
  const ForceSettings force;
  const SandForce sand = force_on_device(0.006, device_with(DragVelocity::sampled), hand, hand_after, force);
  const SandForce plain = sand_force(0.006, 2.0 * moving.velocity, 0.0, force);
  EXPECT_EQ(sand.total, plain.total);
}

TEST(ForceOnDevice, ImplicitDragIsByTheWayOfTheTickItself) {
  for (const DragDirection direction : {DragDirection::horizontal, DragDirection::full}) {
    ForceSettings force;
    force.drag = direction;
    SimulatedDevice device = device_with(DragVelocity::implicit);
    const SandForce sand = force_on_device(0.006, device, hand, hand_after, force);
    device.advance(hand, hand_after, sand.total);
    Eigen::Vector3d velocity = 2.0 * (device.state().position - moving.position) * 1000.0;
    if (direction == DragDirection::horizontal) velocity.z() = 0.0;
    EXPECT_NEAR((sand.drag + force.k_f * sand.repulse * velocity).norm(), 0.0, 1e-9);
  }
}

TEST(ForceOnDevice, ImplicitDragOfALimitedDeviceIsByTheWayThatTheLimitedForceLeaves) {
  for (const DragDirection direction : {DragDirection::horizontal, DragDirection::full})
    for (const double k_f : {1.0, 10.0, 50.0, 200.0})
      for (const double max_force : {0.1, 1.0, 3.0, 5.9}) {
        ForceSettings force;
        force.drag = direction;
        force.k_f = k_f;
        DeviceSettings settings = device_with(DragVelocity::implicit).settings();
        settings.max_force = max_force;
        SimulatedDevice device(settings, moving);
        const SandForce sand = force_on_device(0.006, device, hand, hand_after, force);
        if (sand.saturated) {
          EXPECT_NEAR(sand.total.norm(), max_force, 1e-12);
        }
        device.advance(hand, hand_after, sand.total);
        const Eigen::Vector3d motion = device.state().position - moving.position;
        Eigen::Vector3d velocity = 2.0 * motion * 1000.0;
        if (direction == DragDirection::horizontal) velocity.z() = 0.0;
        // Limited drag takes energy, too; else it is the model's, by the mean velocity of the tick.
        EXPECT_LE(sand.drag.dot(motion), 0.0);
        if (!sand.limited_drag) {
          EXPECT_NEAR((sand.drag + k_f * sand.repulse * velocity).norm(), 0.0,
                      1e-9 * (1.0 + sand.drag.norm()))
              << k_f << " s/m, " << max_force << " N";
        }
      }
}

TEST(ForceOnDevice, LimitedImplicitDragIsToldAndStopsAFreeMassAtMost) {
  DeviceSettings settings = device_with(DragVelocity::implicit).settings();
  settings.scale = 1.0;
  settings.damping = settings.hand_damping = settings.hand_stiffness = 0.0;
  ForceSettings force;
  const double repulse = repulse_force(0.006, force), strongest = 2.0 * settings.mass * settings.servo_rate;
  for (const double fraction : {0.5, 0.999, 1.001, 100.0})
    for (const double max_force : {0.0, 4.0, 1e3}) {
      settings.max_force = max_force;
      force.k_f = fraction * strongest / repulse;
      SimulatedDevice device(settings, moving);
      EXPECT_NEAR(device.strongest_drag(), strongest, 1e-9 * strongest);
      const SandForce sand = force_on_device(0.006, device, hand, hand_after, force);
      EXPECT_EQ(sand.limited_drag, fraction > 1.0 && max_force != 4.0) << fraction << ", " << max_force;
      device.advance(hand, hand_after, sand.total);
      EXPECT_GE(device.state().velocity.x() * moving.velocity.x(), -1e-15) << "drag reversed the motion";
    }
}

TEST(ForceOnDevice, AKinematicDeviceIsDraggedByItsOwnVelocity) {
  const SandForce sand = force_on_device(0.006, device_with(DragVelocity::implicit, DeviceModel::kinematic),
                                         hand, hand_after, ForceSettings{});
  EXPECT_EQ(sand.total, sand_force(0.006, 2.0 * moving.velocity, 0.0, ForceSettings{}).total);
}

TEST(ForceOnDevice, IsANumberAtAnyDepthOnALimitedDeviceWithImplicitDragToo) {
  ForceSettings full;
  full.drag = DragDirection::full;
  DeviceSettings settings;
  settings.model = DeviceModel::dynamic;
  settings.drag = DragVelocity::implicit;
  const SimulatedDevice::State start{Eigen::Vector3d::Zero(), Eigen::Vector3d(0.1, 0.0, -0.1)};
  const SimulatedDevice device(settings, start);
  for (const double depth : {10.0, 1e3, 1e4}) {  // exp(k_c d) overflows from 1.4 km on
    const SandForce force = force_on_device(depth, device, start, start, full);
    EXPECT_NEAR(force.total.norm(), settings.max_force, 1e-12) << depth;
  }
}

}  // namespace
}  // namespace sandstroke
