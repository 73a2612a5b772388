#pragma once

#include <memory>
#include <string>
#include <vector>

#include "haptics/simulated_device.h"
#include "rules/force.h"
#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// The hand as the state that a device would be in.
inline SimulatedDevice::State state_of(const Hand& hand) { return {hand.position, hand.velocity}; }

/// A scene's law of force as the device feels it: the paper's law by depth and velocity, every other law by
/// what the sand does to the tool (TickRecord::wrench); with what the bed's floor does (sim/floor_force.h).
class DeviceForce {
 public:
  virtual ~DeviceForce() = default;

  /// Fills in repulse_force, drag_force and saturated of a tick in contact, and what `result` says of drag.
  /// Returns the force [N] that the device is to exert, within its limit.
  virtual Eigen::Vector3d feel(TickRecord& record, const SimulatedDevice& device,
                               DeviceResult& result) const = 0;
  /// Stiffness and drag of the sand in a tick in contact that was felt.
  virtual FeltSand felt_sand(const TickRecord& record, const DeviceSettings& device) const = 0;
  /// The energy [J, of the device] that the sand may give back at most.
  virtual double stored(const TickRecord& record, const DeviceSettings& device) const = 0;
  /// The keys that make the force smaller, and the key to raise where it is too stiff; empty: none.
  struct Remedy {
    std::vector<std::string> lower;
    std::string raise;
  };
  /// max_drag_force [N]: 0 where drag did nothing.
  virtual Remedy remedy(double max_drag_force) const = 0;
  /// The keys by which a force, stiffness or drag can become too large for a number.
  virtual std::vector<std::string> scales() const { return remedy(0.0).lower; }
  /// Where the law's theory does not hold in a scene whose tool goes through the sand at `fastest` [m/s].
  /// Empty: it holds.
  virtual std::string theory_warning(const Scene& /*scene*/, double /*fastest*/) const { return ""; }
};

std::unique_ptr<DeviceForce> make_device_force(const Scene& scene);

}  // namespace sandstroke
