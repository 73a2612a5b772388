#pragma once

#include <memory>
#include <optional>

#include "haptics/simulated_device.h"
#include "haptics/stroke_sampler.h"
#include "sand/tool.h"

namespace sandstroke {

/// Converts a hand whose heights count from the sand (Stroke::follows_sand) to heights on the bed. It adds
/// the level of the sand that lies under the tip at that moment: the mean height from which the force's depth
/// counts (Tool::sand_level). Beside the bed it keeps the last level.
class SandFollower {
 public:
  SandFollower(const ToolSettings& tool, const DeviceSettings& device)
      : tool_(make_tool(tool)), device_(device) {}

  /// Call it once per servo tick: the velocity includes the change of the level since the last call.
  Hand follow(Hand hand, const HeightField& bed);
  double asked_depth() const { return asked_depth_; }  ///< m below the sand, of the last hand
  /// Call this if the next call is not one tick after the last one.
  void restart() { rise_.reset(); }
  template <class State>
  void visit_state(State& state) {
    state.value("follower.asked_depth", asked_depth_);
    state.value("follower.rise", rise_);
  }

 private:
  std::unique_ptr<Tool> tool_;
  DeviceSettings device_;
  double asked_depth_ = 0.0;
  std::optional<double> rise_;  // m, that the hand was raised in the last call
};

}  // namespace sandstroke
