#pragma once

#include <Eigen/Core>
#include <array>

namespace sandstroke {

/// Finds a device that swings by itself: a loop that is unstable, also where the force limit, or the air
/// above the sand, bounds the swing. By energy, so that the time it takes is the loop's own: along an axis,
/// over successive periods (between two changes of the sign of the velocity relative to the hand's, upwards)
/// in which
/// - the hand is less than half as fast as the device is relative to it, so that it is not the hand's motion,
/// and
/// - the kinetic energy at the fastest has not fallen to half of the largest of these periods, as what
/// settles does, the sand returned, net, more than ten times that largest kinetic energy, and more than it
/// can store.
class SwingWatch {
 public:
  /// A tick. relative: velocity to the hand at its end; hand: the hand's [m/s]; returned: by the sand along
  /// each axis, without what the encoders' rounding may have given [J]; stored: the most that sand can have
  /// stored so far [J]; mass [kg]. True: it swings by itself.
  bool add(const Eigen::Vector3d& relative, const Eigen::Vector3d& hand, const Eigen::Vector3d& returned,
           double stored, double mass);

 private:
  struct Axis {
    double last = 0.0;                                         // m/s
    double fastest = 0.0, hand_fastest = 0.0, returned = 0.0;  // in this period: m/s, m/s, J
    double sum = 0.0, largest = 0.0;                           // over the row of periods: J, J
  };
  std::array<Axis, 3> axes_;
};

}  // namespace sandstroke
