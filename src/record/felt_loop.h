#pragma once

#include <optional>

#include "haptics/haptic_device.h"
#include "sim/scene.h"

namespace sandstroke {

/// The sand of a scene as a device's loop has to hold it, and how hard it may be.
struct FeltLoop {
  double force = 0.0;     ///< N, the largest
  double scale = 1.0;     ///< bed metres per device metre
  bool turns = false;     ///< the tool with the hand
  DeviceSettings device;  ///< servo rate and delay of the loop; mass, damping and hand as the scene has them
  FeltSand felt;          ///< at that force
  FeltSand named;         ///< by the device, as its most; 0: it names none
  FeltSand stable;        ///< up to here the hand on the device settles in theory (stable_sand)

  bool is_stable() const { return felt.stiffness < stable.stiffness && felt.drag < stable.drag; }
  /// What the device does not name does not count.
  bool is_within_named() const {
    return (named.stiffness <= 0.0 || felt.stiffness <= named.stiffness) &&
           (named.drag <= 0.0 || felt.drag <= named.drag);
  }
};

/// N: what the hand may get at most, of the recording (max_force), the device and the scene; any_force: no
/// limit.
double largest_force(const Scene& scene, const DeviceSpecification& device, double max_force);

/// Of the paper's law the sand is stiffest and drags most at the largest force; of a law of the contact it is
/// as stiff as contact_stiffness() says, and drags at any speed alike. None: no force, one without any limit,
/// or a stand-in that takes any and feels none. max_force [N], servo_rate [Hz]: of the recording. lateness
/// [s]: of 99 of 100 ticks, where it was measured. A force acts a whole number of ticks late, at least one: a
/// device takes its time to take it.
std::optional<FeltLoop> felt_loop(const Scene& scene, const DeviceSpecification& device, double max_force,
                                  double servo_rate, std::optional<double> lateness = {});

/// The same scene, whose sand settles. Of the paper's law with the largest k_f and k_s, of two digits; with
/// the largest k_c, where k_s could only be 0. Of a law of the contact with the least force.yield, of two
/// digits; none, where no way would do: the tool is too large. What settles stays.
std::optional<Scene> settling_scene(const FeltLoop& loop, const Scene& scene);

}  // namespace sandstroke
