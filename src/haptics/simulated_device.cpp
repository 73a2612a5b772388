#include "haptics/simulated_device.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

namespace sandstroke {

void apply_device_preset(DeviceSettings& settings) {
  switch (settings.preset) {
    case DevicePreset::omega3:
      settings.max_force = 12.0;
      settings.resolution = 9e-6;
      break;
    case DevicePreset::phantom_desktop:
      settings.max_force = 20.0;
      settings.resolution = 30e-6;
      break;
    case DevicePreset::touch:
      settings.max_force = 3.3;
      settings.resolution = 55e-6;
      break;
    case DevicePreset::ideal:
      settings.max_force = 0.0;
      settings.resolution = 0.0;
      break;
  }
}

DeviceSettings ideal_device() {
  DeviceSettings settings;
  settings.model = DeviceModel::dynamic;
  settings.preset = DevicePreset::ideal;
  apply_device_preset(settings);
  return settings;
}

Eigen::Matrix<double, 2, 5> device_tick_map(const DeviceSettings& settings) {
  // State (x, v, x_hand, v_hand, F). The inputs are states, too, which move uniformly or not at all.
  Eigen::Matrix<double, 5, 5> rate = Eigen::Matrix<double, 5, 5>::Zero();
  const double m = settings.mass;
  rate(0, 1) = 1.0;
  rate.row(1) << -settings.hand_stiffness / m, -(settings.hand_damping + settings.damping) / m,
      settings.hand_stiffness / m, settings.hand_damping / m, 1.0 / m;
  rate(2, 3) = 1.0;
  const Eigen::Matrix<double, 5, 5> tick = (rate / settings.servo_rate).exp();
  return tick.topRows<2>();
}

SimulatedDevice::SimulatedDevice(const DeviceSettings& settings, const State& hand)
    : settings_(settings),
      time_step_(1.0 / settings.servo_rate),
      map_(device_tick_map(settings)),
      state_(hand) {}

SimulatedDevice::State SimulatedDevice::read() const {
  State reading = state_;
  if (settings_.model == DeviceModel::dynamic && settings_.resolution > 0.0) {
    for (double& x : reading.position) x = std::round(x / settings_.resolution) * settings_.resolution;
  }
  if (!past_.empty())
    reading.velocity = (reading.position - past_.front()) / (time_step_ * static_cast<double>(past_.size()));
  else if (differentiates())
    reading.velocity.setZero();
  return reading;
}

Eigen::Vector2d SimulatedDevice::after_tick(int axis, const State& hand, const State& hand_after,
                                            double force) const {
  const double hand_speed = (hand_after.position[axis] - hand.position[axis]) / time_step_;
  Eigen::Matrix<double, 5, 1> before;
  before << state_.position[axis], state_.velocity[axis], hand.position[axis], hand_speed, force;
  return map_ * before;
}

Eigen::Vector3d SimulatedDevice::drag_velocity(const State& hand, const State& hand_after,
                                               const Eigen::Vector3d& force, double drag) const {
  const double way_of_drag = map_(0, 4) * drag;  // per velocity
  Eigen::Vector3d velocity;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = after_tick(axis, hand, hand_after, force[axis])[0] - state_.position[axis];
    velocity[axis] = way / (way_of_drag + std::max(time_step_, way_of_drag));
  }
  return velocity;
}

void SimulatedDevice::advance(const State& hand, const State& hand_after, const Eigen::Vector3d& force) {
  if (settings_.model == DeviceModel::kinematic) {
    state_ = hand_after;
    return;
  }
  if (differentiates()) {
    past_.push_back(read().position);
    if (past_.size() > static_cast<std::size_t>(settings_.velocity_window)) past_.pop_front();
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector2d after = after_tick(axis, hand, hand_after, force[axis]);
    state_.position[axis] = after[0];
    state_.velocity[axis] = after[1];
  }
}

void SimulatedDevice::visit_state(StateVisitor& state) {
  state.value("device.state", state_);
  std::vector<Eigen::Vector3d> past(past_.begin(), past_.end());
  state.list("device.past", past);
  past_.assign(past.begin(), past.end());
}

}  // namespace sandstroke
