#pragma once

#include <optional>

#include "haptics/simulated_device.h"
#include "haptics/stroke_sampler.h"
#include "sand/tool_footprint.h"

namespace sandstroke {

/// Takes a hand whose heights count from the sand (Stroke::follows_sand) to where it is: by the level of the
/// sand under the tip as it lies there just now, the mean height from which the force's depth counts
/// (ToolFootprint::sand_level). Beside the bed the last level goes on.
class SandFollower {
 public:
  SandFollower(const ToolSettings& tool, const DeviceSettings& device) : footprint_(tool), device_(device) {}

  /// Calls come a servo tick apart: what the level changed meanwhile is in the velocity.
  Hand follow(Hand hand, const HeightField& bed);
  double asked_depth() const { return asked_depth_; }  ///< m, below the sand, of the last hand
  /// The next call is no tick after the last one.
  void restart() { rise_.reset(); }

 private:
  ToolFootprint footprint_;
  DeviceSettings device_;
  double asked_depth_ = 0.0;
  std::optional<double> rise_;  // m, of the hand, in the last call
};

}  // namespace sandstroke
