#pragma once

#include <memory>

#include "sim/device_force.h"

namespace sandstroke {

// What the floor of a bed, and its stones, do to a tool: a spring along the least way out of the floor
// (FloorContact), TickRecord::floor_force = ground.stiffness x that way. It comes from a potential, half the
// stiffness times the way's square, so it gives back what it took, and no more.

/// A law of force with the floor's: the sum of both, within the device's maximum. Where the tool is not in
/// the floor it is the law alone.
std::unique_ptr<DeviceForce> with_floor(std::unique_ptr<DeviceForce> law, double stiffness);

/// Error: input, where the loop of a dynamic device would create energy at the floor by itself: where the
/// passivity margin of ground.stiffness is not positive. name: the scene's file.
void check_floor_stiffness(const Scene& scene, const std::string& name);

}  // namespace sandstroke
