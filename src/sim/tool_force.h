#pragma once

#include <memory>

#include "core/error.h"
#include "core/state_visitor.h"
#include "sand/resistive_force.h"
#include "sim/sand_side.h"

namespace sandstroke {

/// A tick in which the tool touches the sand, as a law of force is told of it.
struct ToolInSand {
  const HeightField& bed;
  const Tool& tool;        ///< where it displaced, or met sand, last; its footprint's heights() are the bed's
  Eigen::Vector3d tip;     ///< m
  Eigen::Vector3d motion;  ///< m, by which the tool went there in this tick
  double depth;            ///< m, of its lowest point below the level around it
};

/// A law of the force of the contact: what the sand does to the tool, on the bed's axes.
class ToolForce {
 public:
  virtual ~ToolForce() = default;
  /// A copy with all that it knows, for copies of a simulation; none: it cannot be copied.
  virtual std::unique_ptr<ToolForce> copy() const { return nullptr; }
  /// Error: input, of a law that cannot tell its state, as those of plugins.
  virtual void visit_state(StateVisitor& /*state*/) {
    throw_input_error("the state of a plugin's law of force is not known; it cannot be kept");
  }
  /// Feels in a tick in contact.
  virtual Wrench feel(const ToolInSand& touch) = 0;
  /// The tool touches no sand: what was known of its way is gone.
  virtual void lift() {}
  /// How the tool lies in the bed from the next feel() on.
  virtual void turn(const Eigen::Matrix3d& /*rotation*/) {}

  /// False for a law that never gives a wrench: then feel() is not called.
  virtual bool gives_wrench() const { return true; }

  /// Feels in any tick, in contact or not, after the tool went by `motion` [m] to where it displaced last,
  /// `tip` [m].
  Wrench in_tick(SandSide& sand, const HeightField& bed, const Eigen::Vector3d& tip,
                 const Eigen::Vector3d& motion, bool contact) {
    if (!gives_wrench()) return {};
    if (!contact) {
      lift();
      return {};
    }
    const Tool& tool = sand.tool_on(bed);
    return feel({bed, tool, tip, motion, tool.depth(tip.z())});
  }
};

/// The paper's law has none: it gives the device a force by depth and velocity (DeviceForce).
class NoToolForce : public ToolForce {
 public:
  std::unique_ptr<ToolForce> copy() const override { return std::make_unique<NoToolForce>(); }
  void visit_state(StateVisitor& /*state*/) override {}
  Wrench feel(const ToolInSand& /*touch*/) override { return {}; }
  bool gives_wrench() const override { return false; }
};

}  // namespace sandstroke
