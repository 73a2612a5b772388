#pragma once

#include "haptics/simulated_device.h"
#include "rules/force.h"

namespace sandstroke {

/// The exact one-tick map of a device's loop along an axis. Its state is (x, v, the force that acts in this
/// tick, ..., delay - 1 ticks later, x one tick ago, two, ...). back has 2 + n numbers: each reading gives
/// the force -back (x, v, x one tick ago, ..., n ago), which acts device.delay ticks later. Assumes no
/// dropped ticks and exact encoders.
Eigen::MatrixXd loop_map(const DeviceSettings& device, const Eigen::RowVectorXd& back);

/// Largest modulus of an eigenvalue. Below 1 the loop settles.
double spectral_radius(const Eigen::MatrixXd& map);

/// The resistance along an axis as `back` of loop_map, with a drag by the mean velocity over the last
/// `window` >= 1 ticks.
Eigen::RowVectorXd windowed_feedback(const FeltSand& felt, int window, double servo_rate);

/// The largest stiffness K [N/m] along z, and the largest drag B [N s/m] along x, of sand in which a hand on
/// a device settles. device: mass, damping and hand, servo rate and delay. If the drag's direction is `full`,
/// it also acts along z: with `drag`, or not at all if `drag` is beyond the largest.
FeltSand stable_sand(const DeviceSettings& device, DragDirection direction, double drag, int window);

}  // namespace sandstroke
