#include "haptics/swing_watch.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {

bool SwingWatch::add(const Eigen::Vector3d& relative, const Eigen::Vector3d& hand,
                     const Eigen::Vector3d& returned, double stored, double mass) {
  bool swings = false;
  for (int i = 0; i < 3; ++i) {
    Axis& axis = axes_[static_cast<std::size_t>(i)];
    if (axis.last <= 0.0 && relative[i] > 0.0) {
      const double energy = 0.5 * mass * axis.fastest * axis.fastest;
      const bool by_itself = axis.hand_fastest < 0.5 * axis.fastest && energy > 0.5 * axis.largest;
      axis.sum = by_itself ? std::max(0.0, axis.sum + axis.returned) : 0.0;
      axis.largest = by_itself ? std::max(axis.largest, energy) : 0.0;
      swings = swings || axis.sum > std::max(stored, 10.0 * axis.largest);
      axis.fastest = axis.hand_fastest = axis.returned = 0.0;
    }
    axis.last = relative[i];
    axis.fastest = std::max(axis.fastest, std::abs(relative[i]));
    axis.hand_fastest = std::max(axis.hand_fastest, std::abs(hand[i]));
    axis.returned += returned[i];
  }
  return swings;
}

}  // namespace sandstroke
