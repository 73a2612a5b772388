#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/state_visitor.h"
#include "haptics/simulated_device.h"

namespace sandstroke {

/// Whether the loop is late in a tick. It is late in this fraction (0 to 1) of the ticks, spread at
/// random by a hash of the tick's number, and so the same in every run.
bool drops_tick(std::int64_t tick, double fraction);

/// Delays a force on its way from the sand's model to the device's motors. In a dropped tick the loop is not
/// done in time, and the last force is given out again. A force that is given out in tick k acts in tick k +
/// delay.
class LateForce {
 public:
  /// Takes delay and dropped ticks of the device; `before` [N] acts until the first force does.
  explicit LateForce(const DeviceSettings& settings, const Eigen::Vector3d& before = {0.0, 0.0, 0.0});

  /// Takes the force [N] that was computed in this tick (the first call is tick 0). Returns the force that
  /// acts.
  Eigen::Vector3d act(const Eigen::Vector3d& computed);
  /// Whether the tick of the last call was dropped.
  bool dropped() const { return dropped_; }
  /// Forgets the force that is held and those under way. It does not change which ticks are dropped.
  void clear();
  void visit_state(StateVisitor& state) {
    state.value("late_force.tick", tick_);
    state.value("late_force.dropped", dropped_);
    state.value("late_force.given_out", given_out_);
    state.row("late_force.under_way", under_way_);
  }

 private:
  double dropped_fraction_;
  std::int64_t tick_ = 0;
  bool dropped_ = false;
  Eigen::Vector3d given_out_;
  std::vector<Eigen::Vector3d> under_way_;  // tick k's force at k modulo the size, which is the delay
};

}  // namespace sandstroke
