#include "sim/sand_follower.h"

#include <cmath>

namespace sandstroke {

Hand SandFollower::follow(Hand hand, const HeightField& bed) {
  const Eigen::Vector3d tip = tip_of(device_, hand.position);
  tool_->place(bed, tip.x(), tip.y());
  const double level = tool_->sand_level();
  const double rise = std::isnan(level) ? rise_.value_or(0.0) : level / device_.scale;
  asked_depth_ = -tip.z();
  hand.position.z() += rise;
  hand.velocity.z() += (rise - rise_.value_or(rise)) * device_.servo_rate;
  rise_ = rise;
  return hand;
}

}  // namespace sandstroke
