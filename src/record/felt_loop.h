#pragma once

#include <optional>

#include "haptics/haptic_device.h"
#include "sim/scene.h"

namespace sandstroke {

/// The sand of a scene as a device's loop must hold it, and how hard it may be.
struct FeltLoop {
  double force = 0.0;     ///< N, the largest
  double scale = 1.0;     ///< bed metres per device metre
  bool turns = false;     ///< the tool turns with the hand
  DeviceSettings device;  ///< servo rate and delay of the loop; mass, damping and hand as the scene has them
  FeltSand felt;          ///< at the largest force
  FeltSand named;         ///< the most that the device names; 0: it names none
  FeltSand stable;        ///< up to here the hand on the device settles in theory (stable_sand)

  bool is_stable() const { return felt.stiffness < stable.stiffness && felt.drag < stable.drag; }
  /// A value that the device does not name is not checked.
  bool is_within_named() const {
    return (named.stiffness <= 0.0 || felt.stiffness <= named.stiffness) &&
           (named.drag <= 0.0 || felt.drag <= named.drag);
  }
};

/// The most that the hand may get [N]: the least limit of the recording (max_force), the device and the
/// scene; any_force: no limit.
double largest_force(const Scene& scene, const DeviceSpecification& device, double max_force);

/// The loop of a scene and a device. With the paper's law the sand is stiffest and drags most at the largest
/// force. With a contact law it is as stiff as contact_stiffness() says, and its drag does not depend on
/// speed. None: no force, one without any limit, or a stand-in that takes any force and feels none. max_force
/// [N], servo_rate [Hz]: of the recording. lateness [s]: of 99 of 100 ticks, where it was measured. A force
/// acts a whole number of ticks late, at least one, because a device takes time to apply it.
std::optional<FeltLoop> felt_loop(const Scene& scene, const DeviceSpecification& device, double max_force,
                                  double servo_rate, std::optional<double> lateness = {});

/// The same scene with sand that settles. The paper's law gets the largest k_f and k_s of two digits, or the
/// largest k_c where k_s could only be 0. A contact law gets the least force.yield of two digits; none, where
/// no yield would do: the tool is too large. Values that settle stay.
std::optional<Scene> settling_scene(const FeltLoop& loop, const Scene& scene);

}  // namespace sandstroke
