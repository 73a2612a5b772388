#pragma once

#include <optional>
#include <string>

#include "core/compensated_sum.h"
#include "haptics/late_force.h"
#include "haptics/passivity.h"
#include "haptics/swing_watch.h"
#include "sim/device_force.h"

namespace sandstroke {

/// s: a tool that is below the sand after a gap of the stroke did not come down through it. Its force is
/// multiplied by t / fade_in until t = fade_in after the first tick in the sand, or until it leaves the sand.
/// The energy that it stores meanwhile is not the hand's: DeviceForce::stored(), by the growth of that
/// factor, counts as given.
inline constexpr double fade_in = 0.1;

/// The device's side of a run: where it is, what it feels of the sand, and what that amounts to. The sand's
/// side needs to know where it is, no more: the sand of a kinematic device is the same whatever its forces.
class DeviceSide {
 public:
  explicit DeviceSide(const Scene& scene);

  /// Before the first tick: the device is where the hand is, and moves as it does.
  void start(const Hand& hand);

  const SimulatedDevice& device() const { return device_; }

  /// Fills in forces and passivity margin of a tick of which hand, depth and contact are known.
  void feel(TickRecord& record);
  /// Moves on to the end of that tick. Where the hand is lifted before it, the device goes with the hand, as
  /// fast as it, without force or energy, and late forces are forgotten. Error: unstable, where the force is
  /// beyond any number.
  void advance(const TickRecord& record);

  void visit_state(StateVisitor& state);

  /// Forces, energy and passivity of all ticks so far.
  DeviceResult result() const;

 private:
  /// Error: unstable, if a force or the passivity margin is no finite number.
  void check_numbers(const TickRecord& record) const;
  void bear(Eigen::Vector3d& force, TickRecord& record) const;
  void move(const TickRecord& record);
  void watch(const TickRecord& record, const Eigen::Vector3d& motion);
  double faded_in(const TickRecord& record);

  std::shared_ptr<const DeviceForce> force_;  // knows nothing of the ticks before
  SimulatedDevice device_;
  LateForce late_force_;
  EnergyAccount energy_;
  bool lifted_ = false;
  std::optional<double> fading_since_;  // s
  double fraction_ = 1.0;               // the part of the force that acted in the last tick
  CompensatedSum contact_force_;        // N, over contact ticks
  std::int64_t contact_ticks_ = 0;
  SwingWatch swing_;
  double most_stored_ = 0.0;  // J
  DeviceResult result_;       // all but what the others hold
};

/// The remedies for a loop that is unstable or returns energy: the keys of a scene that have a part in it.
/// "lower force.k_s or device.delay, or raise ..."; with rft and archimedes "lower
/// force.density ..., or raise force.yield ..."; with a plugin law "lower the force that model.force gives
/// ..."; after a run on the floor ground.stiffness, too.
std::string loop_remedies(const Scene& scene, const DeviceResult& result);

}  // namespace sandstroke
