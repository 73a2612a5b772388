#include "haptics/passivity.h"

#include <cmath>

namespace sandstroke {

double passivity_margin(double depth, double repulse, const ForceSettings& force,
                        const DeviceSettings& device) {
  const double damping = device.damping + device.hand_damping;
  if (depth <= 0.0 || force.k_s == 0.0) return damping;
  const double stiffness = device.scale * force.k_s * force.k_c * std::exp(force.k_c * depth);
  const double drag = force.k_f > 0.0 ? device.scale * force.k_f * repulse : 0.0;  // repulse may be infinite
  return damping - (0.5 * stiffness / device.servo_rate + drag);
}

}  // namespace sandstroke
