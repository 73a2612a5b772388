#include "haptics/passivity.h"

namespace sandstroke {

double passivity_margin(double stiffness, double drag, const DeviceSettings& device) {
  return device.damping + device.hand_damping - ((0.5 + device.delay) * stiffness / device.servo_rate + drag);
}

double passivity_margin(double depth, double repulse, const ForceSettings& force,
                        const DeviceSettings& device) {
  const FeltSand sand = felt_sand(depth, repulse, device.scale, force);
  return passivity_margin(sand.stiffness, sand.drag, device);
}

}  // namespace sandstroke
