#pragma once

#include <cstdint>
#include <variant>

#include "haptics/late_force.h"
#include "haptics/simulated_device.h"
#include "rules/force.h"
#include "validation/stress/stress_report.h"

namespace sandstroke {

/// A spring and damper along z that push and pull, as the device feels them. Their rest is at z = 0.
struct Wall {
  double stiffness = 0.0;  ///< N/m
  double damping = 0.0;    ///< N s/m
};

/// The model's sand: it only pushes. Its level stays at z = 0, since displacement does not change the level
/// under the tool. The hand presses the tool to `depth` and draws it along x.
struct PressedSand {
  ForceSettings force;
  double depth = 0.0;  ///< m in the bed, > 0
  double speed = 0.0;  ///< m/s of the device
};

/// The sand of force.law = "rft" under a tool that trembles about its rest along z (ResistiveForce). The
/// force is complete after the yield way, and reverses when the tool does. At rest it is half of its maximum,
/// so it resists both directions as a spring of strength / yield.
struct YieldingSand {
  double strength = 0.0;  ///< N, the force once the sand has yielded
  double yield = 0.001;   ///< m in the bed
  static constexpr double fraction_at_rest = 0.5;
};

/// A dynamic device that a hand holds against something. It starts a little off its rest.
struct LoopSettings {
  DeviceSettings device;
  std::variant<Wall, PressedSand, YieldingSand> against;
  double disturbance = 1e-6;  ///< m, along z and, in PressedSand, x
  double far = 1e3;           ///< m off its rest: a device beyond it has diverged
};

/// Multiplies all forces at the same position by `gain` (for sand: k_s or strength).
LoopSettings with_gain(LoopSettings settings, double gain);

/// The stiffness and damping that resist the device's motion along x and z about its rest.
struct FeltAlong {
  Wall x, z;
};
FeltAlong felt_about_rest(const LoopSettings& settings);

/// Simulates device, force model, delay and dropped ticks, tick by tick.
class DeviceLoop {
 public:
  explicit DeviceLoop(const LoopSettings& settings);

  void tick();
  /// Distance [m] from the device's rest or, when drawn along, from its steady position.
  Eigen::Vector3d off_rest() const;
  /// off_rest() one tick later [m], if the device kept its speed. A device that swings at half the servo rate
  /// is at the same position at the start of every tick: only its speed shows the swing.
  Eigen::Vector3d heading_off_rest() const;
  const SimulatedDevice& device() const { return device_; }
  const Eigen::Vector3d& force() const { return force_; }  ///< N, acted in the last tick

 private:
  SimulatedDevice::State hand_at(std::int64_t tick) const;
  Eigen::Vector3d force_now(const SimulatedDevice::State& hand, const SimulatedDevice::State& next);

  LoopSettings settings_;
  std::int64_t tick_ = 0;
  SimulatedDevice::State rest_;  // of the device, in tick 0
  Eigen::Vector3d lead_;         // m, how far the hand is ahead of the device at rest
  SimulatedDevice device_;
  LateForce late_force_;
  Eigen::Vector3d force_;
  double yielded_ = YieldingSand::fraction_at_rest;  // YieldingSand: force over strength, -1 to 1, and
  double read_z_;                                    // where the device was read then, m
};

struct LoopRun {
  Verdict verdict = Verdict::broken;
  double swing = 0.0;   ///< m, peak to peak over the last window, along x or z
  double growth = 0.0;  ///< swing of the last window over that of one half the run earlier
};

/// Runs the loop for `ticks`, or until the verdict is clear from the peak-to-peak swing in each of 16
/// windows:
/// - diverged: the device is farther than `far` off its rest. Against a wall, where a growing swing grows for
///   ever, a swing that doubled over the second half is enough.
/// - stable: the swing fell to 1e-4 of the disturbance; or it fell by more than half over the second half and
///   still falls; or it is within one step of the encoders, which they cannot tell from rest.
/// - limit_cycle: all others. A dither of more than one encoder step, caused by rounding, is one.
LoopRun run_loop(const LoopSettings& settings, std::int64_t ticks);

}  // namespace sandstroke
