#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "haptics/simulated_device.h"

namespace sandstroke {

/// True for the ticks in which the loop is late: `share` of them (0 to 1), spread at random by a hash of the
/// tick's number, and so the same in every run.
bool drops_tick(std::int64_t tick, double share);

/// The way of a force from the sand's model to the device's motors. In a dropped tick the loop is not done in
/// time, and the last force is given out again; what is given out in tick k acts in tick k + delay.
class LateForce {
 public:
  /// Delay and dropped ticks of the device; `before` [N] acts until the first force does.
  explicit LateForce(const DeviceSettings& settings, const Eigen::Vector3d& before = {0.0, 0.0, 0.0});

  /// Takes the force [N] that was computed in this tick (the first call is tick 0); gives the one that acts.
  Eigen::Vector3d act(const Eigen::Vector3d& computed);
  /// Whether the tick of the last call was dropped.
  bool dropped() const { return dropped_; }
  /// No force is held or under way any more; which ticks are dropped stays as it was.
  void clear();

 private:
  double dropped_share_;
  std::int64_t tick_ = 0;
  bool dropped_ = false;
  Eigen::Vector3d given_out_;
  std::vector<Eigen::Vector3d> under_way_;  // tick k's at k modulo its size, the delay
};

}  // namespace sandstroke
