#pragma once

#include "sand/resistive_force.h"
#include "sim/sand_side.h"

namespace sandstroke {

/// What a law of force is told of a tick in which the tool touches the sand.
struct ToolInSand {
  const HeightField& bed;
  const Tool& tool;        ///< where it displaced last; its footprint's heights() are the bed's
  Eigen::Vector3d tip;     ///< m
  Eigen::Vector3d motion;  ///< m, by which the tool went there in this tick
  double depth;            ///< m, of its lowest point below the level around it
};

/// A law of the force of the contact: what the sand does to the tool, on the bed's axes.
class ToolForce {
 public:
  virtual ~ToolForce() = default;
  /// Of a tick in contact. A device of limited force gets Wrench::limited(), so `strength` counts.
  virtual Wrench feel(const ToolInSand& touch) = 0;
  /// The tool touches no sand: what was known of its way is gone.
  virtual void lift() {}
  /// How the tool lies in the bed from the next feel() on.
  virtual void turn(const Eigen::Matrix3d& /*rotation*/) {}

  /// Of any tick, after the tool went by `motion` [m] to where it displaced last, `tip` [m], in contact or
  /// not.
  Wrench in_tick(SandSide& sand, const HeightField& bed, const Eigen::Vector3d& tip,
                 const Eigen::Vector3d& motion, bool contact) {
    if (!contact) {
      lift();
      return {};
    }
    const Tool& tool = sand.tool_on(bed);
    return feel({bed, tool, tip, motion, tool.sand_level() - (tip.z() + tool.lowest())});
  }
};

}  // namespace sandstroke
