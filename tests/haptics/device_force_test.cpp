#include "haptics/device_force.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(ForceOnDevice, OfALimitedDeviceIsANumberAtAnyDepthWithImplicitDragToo) {
  ForceSettings full;
  full.drag = DragDirection::full;
  DeviceSettings settings;
  settings.model = DeviceModel::dynamic;
  settings.drag = DragVelocity::implicit;
  const SimulatedDevice::State hand{Eigen::Vector3d::Zero(), Eigen::Vector3d(0.1, 0.0, -0.1)};
  const SimulatedDevice device(settings, hand);
  for (const double depth : {10.0, 1e3, 1e4}) {  // exp(k_c d) overflows from 1.4 km on
    const SandForce force = force_on_device(depth, device, hand, hand, full);
    EXPECT_NEAR(force.total.norm(), settings.max_force, 1e-12) << depth;
  }
}

}  // namespace
}  // namespace sandstroke
