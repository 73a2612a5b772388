#pragma once

#include <Eigen/Core>
#include <deque>

#include "core/state_visitor.h"
#include "rules/schedule.h"

namespace sandstroke {

/// kinematic: the device is where the hand is. dynamic: a mass held by the hand's spring, which feels the
/// force.
enum class DeviceModel { kinematic, dynamic };
/// The velocity that drag depends on. sampled: the one read at the start of the tick, as published. implicit:
/// one of the tick itself (SimulatedDevice::drag_velocity), so that drag can only take energy.
enum class DragVelocity { sampled, implicit };
/// The velocity that is read. exact: the device's own. encoders: a difference of read positions over
/// velocity_window ticks, as with devices that measure no velocity; it lags by half of them.
enum class ReadVelocity { exact, encoders };
enum class DevicePreset { omega3, phantom_desktop, touch, ideal };

/// The simulated haptic device. Force limit and resolution come with the preset (omega3 and phantom_desktop:
/// paper 4.2); mass, damping and the hand are typical values, not measured ones.
struct DeviceSettings {
  DeviceModel model = DeviceModel::kinematic;
  DevicePreset preset = DevicePreset::omega3;
  double servo_rate = published_servo_rate;          ///< Hz
  double scale = 1.0;                                ///< bed metres per device metre
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m, bed position of the device's origin
  double max_force = 12.0;                           ///< N; 0 = no limit
  double resolution = 9e-6;                          ///< m, of the encoders (dynamic model); 0 = exact
  double mass = 0.25;                                ///< kg
  double damping = 1.0;                              ///< N s/m
  double hand_stiffness = 400.0;                     ///< N/m
  double hand_damping = 8.0;                         ///< N s/m
  // The dynamic model's loop (LateForce):
  int delay = 0;               ///< ticks from reading the position to the force that follows from it
  double dropped_ticks = 0.0;  ///< fraction of ticks (below 1) with a late loop: its last force stays
  DragVelocity drag = DragVelocity::sampled;
  ReadVelocity velocity = ReadVelocity::exact;
  int velocity_window = 4;  ///< ticks, as in record --feel
};

/// Sets max_force and resolution to those of settings.preset.
void apply_device_preset(DeviceSettings& settings);

/// Position on the bed [m] of the tip of a device that is at `position` [device m].
inline Eigen::Vector3d tip_of(const DeviceSettings& settings, const Eigen::Vector3d& position) {
  return settings.scale * position + settings.offset;
}

/// A dynamic device with exact encoders and no force limit; all else is the default.
DeviceSettings ideal_device();

/// The exact map of one tick of the device along one axis (matrix exponential of the linear plant m a = k_h
/// (x_hand - x) + b_h (v_hand - v) - b v + F). During the tick the force F is held and the hand moves
/// uniformly: (x, v) after = map * (x, v, x_hand, v_hand, F) before.
Eigen::Matrix<double, 2, 5> device_tick_map(const DeviceSettings& settings);

/// The device's motion, in device metres. Any instability is the sampled-data system's own.
class SimulatedDevice {
 public:
  struct State {
    Eigen::Vector3d position, velocity;  ///< m, m/s

    template <class State>
    void visit_state(State& state) {
      state.value("position", position);
      state.value("velocity", velocity);
    }
  };

  /// Starts at the hand, with its velocity.
  SimulatedDevice(const DeviceSettings& settings, const State& hand);

  /// Puts the device at the hand, with the hand's velocity.
  void put(const State& hand) {
    state_ = hand;
    past_.clear();
  }
  /// The state as the controller reads it (dynamic model): the position rounded to the encoders' resolution,
  /// and the velocity. By encoders it is 0 at first, then over as many ticks as there are.
  State read() const;
  /// The true state.
  const State& state() const { return state_; }
  const DeviceSettings& settings() const { return settings_; }

  /// The velocity u [m/s], per axis, for DragVelocity::implicit. With it a held drag force -drag u, drag >= 0
  /// [N s/m], beside the held `force` [N], takes energy whatever the drag, mass, hand and time step T.
  /// With way = x_free - x, the way of the tick without drag, and g = map(0,4) > 0, the way that a held
  /// newton makes: u = way / (g drag + max(T, g drag)).
  /// - If g drag <= T: u = (way - g drag u) / T, the mean velocity of this very tick: second order in T.
  /// - Above it that drag would reverse the motion (v -> -v for drag -> infinity). Then u is as large as
  ///   stops a free mass at the tick's end, where g = T^2 / (2 m).
  /// In both cases the device moves by way - g drag u, which has the sign of u: the energy
  /// drag u (way - g drag u) >= 0 goes into the sand. (Drag by the velocity at the tick's end may not:
  /// map(1,4) < 0 if the hand swings the mass through more than half a period in a tick.) Assumes that the
  /// force acts in this very tick, and that the hand's way in it is known.
  Eigen::Vector3d drag_velocity(const State& hand, const State& hand_after, const Eigen::Vector3d& force,
                                double drag) const;

  /// T / g [N s/m], which is 2 m / T for a free mass. drag_velocity() holds larger drag to what stops the
  /// device.
  double strongest_drag() const { return time_step_ / map_(0, 4); }

  void visit_state(StateVisitor& state);

  /// Advances by one tick, during which the hand goes from one position to the next and `force` [N] is held.
  void advance(const State& hand, const State& hand_after, const Eigen::Vector3d& force);

 private:
  bool differentiates() const {
    return settings_.model == DeviceModel::dynamic && settings_.velocity == ReadVelocity::encoders;
  }
  /// Position and velocity along one axis after a tick.
  Eigen::Vector2d after_tick(int axis, const State& hand, const State& hand_after, double force) const;

  DeviceSettings settings_;
  double time_step_;
  Eigen::Matrix<double, 2, 5> map_;
  State state_;
  std::deque<Eigen::Vector3d> past_;  // m, read in the last ticks, for ReadVelocity::encoders
};

}  // namespace sandstroke
