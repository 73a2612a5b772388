// SimulatedDevice::drag_velocity and the drag by it, on which device.drag = "implicit" rests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/simulated_device.h"

namespace sandstroke {
namespace {

using State = SimulatedDevice::State;

DeviceSettings light_device(double servo_rate) {
  DeviceSettings settings = ideal_device();
  settings.mass = 0.05;
  settings.damping = 0.1;
  settings.hand_stiffness = 2000.0;
  settings.hand_damping = 0.5;
  settings.servo_rate = servo_rate;
  return settings;
}

const State fast{{1e-3, -2e-3, 3e-3}, {0.2, -0.1, 0.05}};
const State held_hand{{0.0, 0.0, 0.0}, {0.1, 0.0, -0.1}}, next_hand{{1e-4, 0.0, -1e-4}, {0.1, 0.0, -0.1}};

TEST(DragVelocity, IsTheMeanOneOfTheTick) {
  for (const double rate : {50.0, 1000.0, 20000.0})
    for (const double drag : {0.0, 0.1, 1.0, 4.9}) {  // below 2 m / T
      SimulatedDevice device(light_device(rate), fast);
      const Eigen::Vector3d pressing(0.0, 0.0, 2.0);
      const Eigen::Vector3d velocity = device.drag_velocity(held_hand, next_hand, pressing, drag);
      device.advance(held_hand, next_hand, pressing - drag * velocity);
      const Eigen::Vector3d motion = device.state().position - fast.position;
      EXPECT_NEAR((motion * rate - velocity).norm(), 0.0, 1e-9) << rate << " Hz, " << drag << " N s/m";
    }
}

TEST(DragVelocity, IsTheFreeDevicesWithoutDrag) {
  SimulatedDevice device(light_device(1000.0), fast);
  const Eigen::Vector3d velocity = device.drag_velocity(held_hand, next_hand, Eigen::Vector3d::Zero(), 0.0);
  device.advance(held_hand, next_hand, Eigen::Vector3d::Zero());
  EXPECT_NEAR((device.state().position - fast.position - 1e-3 * velocity).norm(), 0.0, 1e-15);
}

TEST(DragVelocity, TendsToTheReadVelocityInShortTicks) {
  const SimulatedDevice device(light_device(1e6), fast);
  const Eigen::Vector3d velocity = device.drag_velocity(held_hand, held_hand, Eigen::Vector3d::Zero(), 10.0);
  EXPECT_NEAR((velocity - fast.velocity).norm(), 0.0, 1e-3 * fast.velocity.norm());
}

TEST(DragVelocity, StopsAFreeMassAtMost) {
  DeviceSettings settings = light_device(1000.0);
  settings.damping = settings.hand_stiffness = settings.hand_damping = 0.0;
  const double m = settings.mass, deadbeat = 2.0 * m * 1000.0;
  for (const double drag : {0.1 * deadbeat, 0.99 * deadbeat, deadbeat, 3.0 * deadbeat, 1e9 * deadbeat}) {
    SimulatedDevice device(settings, fast);
    const Eigen::Vector3d velocity = device.drag_velocity(fast, fast, Eigen::Vector3d::Zero(), drag);
    device.advance(fast, fast, -drag * velocity);
    const double fraction = std::min(drag / deadbeat, 1.0);  // the trapezoidal rule's, as far as it brakes
    const Eigen::Vector3d expected = (1.0 - fraction) / (1.0 + fraction) * fast.velocity;
    EXPECT_NEAR((device.state().velocity - expected).norm(), 0.0, 1e-12) << drag;
  }
}

TEST(ImplicitDrag, IsAPlainDampersInTheLimitOfShortTicks) {
  // A mass that only drag stops: x = x0 + v0 m/B (1 - exp(-B t/m)). The error shrinks with the time step
  // squared.
  const double B = 5.0, seconds = 0.02;
  double error_before = 0.0;
  for (const double rate : {1000.0, 2000.0, 4000.0}) {
    DeviceSettings settings = light_device(rate);
    settings.damping = settings.hand_stiffness = settings.hand_damping = 0.0;
    SimulatedDevice device(settings, fast);
    for (int k = 0; k < static_cast<int>(seconds * rate); ++k)
      device.advance(fast, fast, -B * device.drag_velocity(fast, fast, Eigen::Vector3d::Zero(), B));
    const double m = settings.mass;
    const Eigen::Vector3d exact = fast.position + fast.velocity * m / B * -std::expm1(-B * seconds / m);
    const double error = (device.state().position - exact).norm();
    if (error_before > 0.0) {
      EXPECT_NEAR(error_before / error, 4.0, 0.1) << rate;
    }
    error_before = error;
  }
}

TEST(ImplicitDrag, TakesEnergyInEveryTickWhateverDragAndTimeStep) {
  for (const double rate :
       {20.0, 50.0, 1000.0, 20000.0})  // at 20 Hz the hand swings the mass 1.6 times a tick
    for (const double drag : {1e-3, 1.0, 1e3, 1e6}) {
      const State rest{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
      SimulatedDevice device(light_device(rate), fast);
      for (int k = 0; k < 20'000; ++k) {
        const Eigen::Vector3d force = -drag * device.drag_velocity(rest, rest, Eigen::Vector3d::Zero(), drag);
        const Eigen::Vector3d before = device.state().position;
        device.advance(rest, rest, force);
        const Eigen::Vector3d motion = device.state().position - before;
        ASSERT_LE((force.array() * motion.array()).maxCoeff(), 1e-15) << rate << " Hz, " << drag << " N s/m";
      }
      EXPECT_LT(device.state().position.norm(), 2.0 * fast.position.norm());
    }
}

}  // namespace
}  // namespace sandstroke
