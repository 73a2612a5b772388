#pragma once

#include "haptics/simulated_device.h"

namespace sandstroke {

/// b + b_h - (K (T / 2 + delay) + |B|) [N s/m]: if it is positive, the sampled loop cannot create energy.
/// Colgate & Schenkel (1997) ask for b > T/2 max over angles w of Re((1 - e^-iw) H(e^iw)) / (1 - cos w). For
/// a spring that acts n ticks late, H = K e^-inw, that is K T/2 sin((n + 1/2) w) / sin(w/2) <= K T (n + 1/2);
/// for drag by differences of positions, at most |B| whatever n. (Here drag is by the velocity read. There is
/// no theorem for that, but tests/stress found no counterexample among thousands of loops.) It does not count
/// dropped ticks. K [N/m], B [N s/m].
inline double passivity_margin(double stiffness, double drag, const DeviceSettings& device) {
  return device.damping + device.hand_damping - ((0.5 + device.delay) * stiffness / device.servo_rate + drag);
}

/// Energy that a device has given to the sand (Hannaford & Ryu 2002). Exact for a force held during each
/// tick.
class EnergyAccount {
 public:
  /// Adds a force [N] on the device while it moved by `motion` [m].
  void add(const Eigen::Vector3d& force, const Eigen::Vector3d& motion) {
    absorbed_ -= force.dot(motion);
    least_ = absorbed_ < least_ ? absorbed_ : least_;
  }
  /// Adds energy [J] that the sand received in another way, and may return.
  void give(double energy) { absorbed_ += energy; }
  template <class State>
  void visit_state(State& state) {
    state.value("absorbed", absorbed_);
    state.value("least", least_);
  }
  double absorbed() const { return absorbed_; }  ///< J
  double least() const {
    return least_;
  }  ///< J, its minimum so far; negative = sand returned more than it took

 private:
  double absorbed_ = 0.0, least_ = 0.0;
};

}  // namespace sandstroke
