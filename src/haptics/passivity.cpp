#include "haptics/passivity.h"

namespace sandstroke {

double passivity_margin(double depth, double repulse, const ForceSettings& force,
                        const DeviceSettings& device) {
  const double damping = device.damping + device.hand_damping;
  const FeltSand sand = felt_sand(depth, repulse, device.scale, force);
  return damping - ((0.5 + device.delay) * sand.stiffness / device.servo_rate + sand.drag);
}

}  // namespace sandstroke
