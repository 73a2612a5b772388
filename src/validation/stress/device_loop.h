#pragma once

#include <cstdint>
#include <variant>

#include "haptics/force_model.h"
#include "haptics/late_force.h"
#include "haptics/simulated_device.h"
#include "validation/stress/stress_report.h"

namespace sandstroke {

/// A two-sided spring and damper along z, as the device feels it, at rest at z = 0.
struct Wall {
  double stiffness = 0.0;  ///< N/m
  double damping = 0.0;    ///< N s/m
};

/// The sand as it is, one-sided, its level at z = 0 whatever the tool does (displacement does not change the
/// level under the tool). The hand presses the tool to `depth` and draws it along x.
struct PressedSand {
  ForceSettings force;
  double depth = 0.0;  ///< m in the bed, > 0
  double speed = 0.0;  ///< m/s of the device
};

/// The sand of force.law = "rft" under a tool that trembles about its rest, along z: a force that is all
/// there after the yield way and turns round as the tool does (ResistiveForce). At rest it is half of what it
/// may be, so that it resists either way as a spring of strength / yield.
struct YieldingSand {
  double strength = 0.0;  ///< N, when it has yielded
  double yield = 0.001;   ///< m in the bed
  static constexpr double share_at_rest = 0.5;
};

/// A dynamic device held against something by a hand, a little off its rest at first.
struct LoopSettings {
  DeviceSettings device;
  std::variant<Wall, PressedSand, YieldingSand> against;
  double disturbance = 1e-6;  ///< m, along z and, in sand, x
  double far = 1e3;           ///< m off its rest, where a device has diverged
};

/// The same with all of its forces `gain` times as strong at the same place (for sand: k_s, strength).
LoopSettings with_gain(LoopSettings settings, double gain);

/// What resists the device's motion along x and z about its rest.
struct FeltAlong {
  Wall x, z;
};
FeltAlong felt_about_rest(const LoopSettings& settings);

/// Device, force model, delay and dropped ticks, tick by tick.
class DeviceLoop {
 public:
  explicit DeviceLoop(const LoopSettings& settings);

  void tick();
  /// m, from where the device would rest or, drawn along, steadily be.
  Eigen::Vector3d off_rest() const;
  /// m, from where it would be a tick later, with the speed that it has. At half the servo rate a device
  /// turns round within each tick and is in the same place at every start of one: only its speed tells.
  Eigen::Vector3d heading_off_rest() const;
  const SimulatedDevice& device() const { return device_; }
  const Eigen::Vector3d& force() const { return force_; }  ///< N, that acted in the last tick

 private:
  SimulatedDevice::State hand_at(std::int64_t tick) const;
  Eigen::Vector3d force_now(const SimulatedDevice::State& hand, const SimulatedDevice::State& next);

  LoopSettings settings_;
  std::int64_t tick_ = 0;
  SimulatedDevice::State rest_;  // of the device, in tick 0
  Eigen::Vector3d lead_;         // m, of the hand before the device at rest
  SimulatedDevice device_;
  LateForce late_force_;
  Eigen::Vector3d force_;
  double yielded_ = YieldingSand::share_at_rest;  // of YieldingSand, the share of its strength, -1 to 1,
  double read_z_;                                 // m of the device, there
};

struct LoopRun {
  Verdict verdict = Verdict::broken;
  double swing = 0.0;   ///< m, peak to peak over the last window, along x or z
  double growth = 0.0;  ///< swing of the last window over that of one half the run earlier
};

/// Runs the loop for so many ticks or until it is decided, by the swing, peak to peak, over each of 16
/// windows:
/// - diverged: off its rest by more than `far`; against a wall, where what grows grows for ever, also where
///   the swing doubled over the second half.
/// - stable: the swing fell to 1e-4 of the disturbance, or to less than half over the second half and still
///   falls, or is within one step of the encoders, which they cannot tell from rest.
/// - limit_cycle: neither. A dither of more than one encoder step is one, by quantisation.
LoopRun run_loop(const LoopSettings& settings, std::int64_t ticks);

}  // namespace sandstroke
