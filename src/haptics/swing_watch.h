#pragma once

#include <Eigen/Core>
#include <array>

namespace sandstroke {

/// Finds a device that swings by itself: its loop is unstable, even if the force limit, or the air above the
/// sand, bounds the swing. It judges by energy, so it takes as long as the loop itself does. It looks at
/// periods along an axis, each between two changes of sign, upwards, of the velocity relative to the hand's.
/// The device swings by itself if, over successive periods in which
/// - the hand is less than half as fast as the device is relative to it, so that the hand does not move it,
/// and
/// - the kinetic energy at the fastest has not fallen to half of the largest of these periods, as it does
/// when a device settles,
/// the sand returned, net, more than ten times that largest kinetic energy, and more than it can store.
class SwingWatch {
 public:
  /// Adds a tick. relative: the device's velocity relative to the hand, at the tick's end; hand: the hand's
  /// velocity [m/s]; returned: what the sand returned along each axis, without what the encoders' rounding
  /// may have given [J]; stored: the most that sand can have stored so far [J]; mass [kg]. True: the device
  /// swings by itself.
  bool add(const Eigen::Vector3d& relative, const Eigen::Vector3d& hand, const Eigen::Vector3d& returned,
           double stored, double mass);

  template <class State>
  void visit_state(State& state) {
    for (Axis& axis : axes_) state.value("axis", axis);
  }

 private:
  struct Axis {
    double last = 0.0;                                         // m/s
    double fastest = 0.0, hand_fastest = 0.0, returned = 0.0;  // in this period: m/s, m/s, J
    double sum = 0.0, largest = 0.0;                           // over the successive periods: J, J

    template <class State>
    void visit_state(State& state) {
      state.value("last", last);
      state.value("fastest", fastest);
      state.value("hand_fastest", hand_fastest);
      state.value("returned", returned);
      state.value("sum", sum);
      state.value("largest", largest);
    }
  };
  std::array<Axis, 3> axes_;
};

}  // namespace sandstroke
