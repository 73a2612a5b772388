#pragma once

#include "haptics/force_model.h"
#include "haptics/simulated_device.h"

namespace sandstroke {

/// What sand does to a device whose tip is `depth` [m] below the level, as a controller computes it in the
/// tick in which the hand goes from one place to the next: drag by the velocity that device.drag says.
SandForce force_on_device(double depth, const SimulatedDevice& device, const SimulatedDevice::State& hand,
                          const SimulatedDevice::State& hand_after, const ForceSettings& settings);

}  // namespace sandstroke
