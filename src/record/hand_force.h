#pragma once

#include <memory>

#include "haptics/stroke_placement.h"
#include "record/felt_force.h"
#include "sim/sand_side.h"
#include "sim/scene.h"

namespace sandstroke {

/// A tool after it moved in a tick.
struct MovedTool {
  SandSide& sand;
  const HeightField& bed;
  const Interaction& interaction;
  const Eigen::Vector3d& tip;       ///< m, in the bed
  const Eigen::Vector3d& motion;    ///< m, of the tip since the last tick
  const Eigen::Vector3d& velocity;  ///< m/s, of the tip, for the drag
};

/// A scene's law of force as the hand on a real device feels it. It is called in the servo loop: it must not
/// wait, throw, or take memory.
class HandForce {
 public:
  virtual ~HandForce() = default;

  /// How the tool lies in the bed from the next feel() on.
  virtual void turn(const Eigen::Matrix3d& /*rotation*/) {}
  /// The tool touches no sand: what was known of its way is gone.
  virtual void lift() {}
  /// Sets the force and the force due, and adds flags.
  virtual void feel(const MovedTool& tool, FeltForce& felt) = 0;
};

/// placement: from the device's frame to the bed's. largest_force [N]: the most that the hand may get from
/// the device.
std::unique_ptr<HandForce> make_hand_force(const Scene& scene, double cell_size,
                                           const PointPlacement& placement, double largest_force);

}  // namespace sandstroke
