#pragma once

#include "haptics/simulated_device.h"
#include "rules/force.h"

namespace sandstroke {

/// The one-tick map of a device's loop along an axis, exactly, of (x, v, the force that acts in this tick,
/// ..., delay - 1 ticks later, x one tick ago, two, ...). back, (2 + n): the force -back (x, v, x one tick
/// ago, ..., n ago) follows from each reading, and acts device.delay ticks later. Presumes no dropped ticks
/// and exact encoders.
Eigen::MatrixXd loop_map(const DeviceSettings& device, const Eigen::RowVectorXd& back);

/// Largest modulus of an eigenvalue: below 1, the loop settles.
double spectral_radius(const Eigen::MatrixXd& map);

/// What resists an axis as `back` of loop_map, with a drag by the mean velocity over the last `window` >= 1
/// ticks.
Eigen::RowVectorXd windowed_feedback(const FeltSand& felt, int window, double servo_rate);

/// The stiffest [N/m] and the most dragging [N s/m] sand that a hand on a device settles in: the largest K
/// along z, and the largest B along x. device: mass, damping and hand, servo rate and delay. In z the drag
/// acts too where its direction is `full`: it is `drag` there, or, where that is beyond the largest, none.
FeltSand stable_sand(const DeviceSettings& device, DragDirection direction, double drag, int window);

}  // namespace sandstroke
