#include "haptics/sand_force.h"

#include <algorithm>

namespace sandstroke {

SandForce force_on_device(double depth, const SimulatedDevice& device, const SimulatedDevice::State& hand,
                          const SimulatedDevice::State& hand_after, const ForceSettings& settings) {
  const DeviceSettings& d = device.settings();
  Eigen::Vector3d velocity = device.state().velocity;
  if (d.model == DeviceModel::dynamic && d.drag == DragVelocity::implicit) {
    // So large that the velocity depends on it no more; beyond, it would be infinity / infinity.
    const double repulse = std::min(repulse_force(depth, settings), 1e100);
    velocity = device.drag_velocity(hand, hand_after, {0.0, 0.0, repulse},
                                    felt_sand(depth, repulse, d.scale, settings).drag);
  }
  return sand_force(depth, d.scale * velocity, d.max_force, settings);
}

}  // namespace sandstroke
