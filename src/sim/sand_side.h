#pragma once

#include <limits>
#include <optional>

#include "sand/displacement.h"

namespace sandstroke {

/// What sand and tool have to do with each other in one tick.
struct Touch {
  double level =
      std::numeric_limits<double>::quiet_NaN();  ///< m, of the sand under the tool; NaN: none there
  double depth = 0.0;                            ///< m, of the tip below the level; negative = above
  double displaced_volume = 0.0;                 ///< m^3
  bool contact = false;                          ///< depth > 0
};

/// The sand's side of a tick: a tool that goes through a bed, from place to place.
class SandSide {
 public:
  SandSide(const ToolSettings& tool, const DisplacementSettings& displacement)
      : footprint_(tool), displacement_(displacement) {}

  /// Displaces along the way from the last tick's place and at this one [m]. read_tip: as the device's
  /// encoders read it; true_tip: where it is, for encoder steps are no motion. highest [m]: no sand is
  /// higher; none: it is looked up where it matters (displace_between).
  Touch move(HeightField& bed, const Eigen::Vector3d& read_tip, const Eigen::Vector3d& true_tip,
             std::optional<double> highest = {});
  /// The same place, without displacing anything.
  Touch look(const HeightField& bed, const Eigen::Vector3d& read_tip);
  /// The next move() begins anew: nothing is displaced on the way to it.
  void lift() { last_tip_.reset(); }

  const ToolFootprint& footprint() const { return footprint_; }
  /// Where it was in the last tick [m]; none where it was lifted since.
  const std::optional<Eigen::Vector3d>& last_tip() const { return last_tip_; }

 private:
  ToolFootprint footprint_;
  DisplacementSettings displacement_;
  std::optional<Eigen::Vector3d> last_tip_;  // the true one
};

}  // namespace sandstroke
