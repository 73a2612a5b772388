#include "haptics/sand_force.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {
namespace {

using State = SimulatedDevice::State;

struct ImplicitDrag {
  Eigen::Vector3d velocity;  // m/s, of the device
  bool limited;
};

ImplicitDrag implicit_drag(double depth, const SimulatedDevice& device, const State& hand,
                           const State& hand_after, const ForceSettings& settings) {
  const DeviceSettings& d = device.settings();
  // Above 1e100 the velocity does not depend on it any more, and would become infinity / infinity.
  const double repulse = std::min(repulse_force(depth, settings), 1e100);
  const double drag = felt_sand(depth, repulse, d.scale, settings).drag;
  const auto velocity = [&](double fraction) {
    return device.drag_velocity(hand, hand_after, {0.0, 0.0, fraction * repulse}, fraction * drag);
  };
  const auto too_much = [&](double fraction) {
    Eigen::Vector3d dragged = velocity(fraction);
    if (settings.drag == DragDirection::horizontal) dragged.z() = 0.0;
    const Eigen::Vector3d repulsed(0.0, 0.0, fraction * repulse);
    return d.max_force > 0.0 && length_of(repulsed - fraction * drag * dragged) > d.max_force;
  };
  double fraction = 1.0;
  if (too_much(1.0)) {
    const double limited_from = device.strongest_drag() / drag;
    double low = 1e-120, high = limited_from < 1.0 && too_much(limited_from) ? limited_from : 1.0;
    for (int i = 0; i < 64; ++i) {
      const double middle = std::sqrt(low * high);
      if (too_much(middle))
        high = middle;
      else
        low = middle;
    }
    fraction = low;
  }
  return {velocity(fraction), fraction * drag > device.strongest_drag()};
}

}  // namespace

SandForce force_on_device(double depth, const SimulatedDevice& device, const State& hand,
                          const State& hand_after, const ForceSettings& settings) {
  const DeviceSettings& d = device.settings();
  if (d.model == DeviceModel::kinematic || d.drag == DragVelocity::sampled)
    return sand_force(depth, d.scale * device.read().velocity, d.max_force, settings);
  const ImplicitDrag drag = implicit_drag(depth, device, hand, hand_after, settings);
  SandForce force = sand_force(depth, d.scale * drag.velocity, d.max_force, settings);
  force.limited_drag = drag.limited;
  return force;
}

}  // namespace sandstroke
