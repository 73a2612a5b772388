#include "haptics/passivity.h"

namespace sandstroke {

double passivity_margin(double stiffness, double drag, const DeviceSettings& device) {
  return device.damping + device.hand_damping - ((0.5 + device.delay) * stiffness / device.servo_rate + drag);
}

}  // namespace sandstroke
