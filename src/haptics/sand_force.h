#pragma once

#include "haptics/simulated_device.h"
#include "rules/force.h"

namespace sandstroke {

/// The sand's force on a device whose tip is `depth` [m] below the level, as a controller computes it in the
/// tick in which the hand goes from one position to the next. Drag is by the velocity that device.drag says.
///
/// Implicit drag with a limit: the force that acts is the fraction s of R - B u, where R is the repulse
/// force, B the drag felt, and u = drag_velocity() of s R and s B. s is 1, or such that the force is
/// max_force. If s B <= strongest_drag(), u is the mean velocity of the tick under the force that acts. With
/// horizontal drag that force grows with s, so there is one solution. With full drag the smallest s is taken,
/// one at which drag is not limited if there is one. Drag takes energy for any s (drag_velocity).
SandForce force_on_device(double depth, const SimulatedDevice& device, const SimulatedDevice::State& hand,
                          const SimulatedDevice::State& hand_after, const ForceSettings& settings);

}  // namespace sandstroke
