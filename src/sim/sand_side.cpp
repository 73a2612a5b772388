#include "sim/sand_side.h"

#include <cmath>

#include "sand/tool_path.h"

namespace sandstroke {

Touch SandSide::look(const HeightField& bed, const Eigen::Vector3d& read_tip) {
  footprint_.place(bed, read_tip.x(), read_tip.y());
  Touch touch;
  touch.level = footprint_.sand_level();
  const double depth = touch.level - read_tip.z();
  touch.contact = depth > 0.0;
  if (!std::isnan(depth)) touch.depth = depth;
  return touch;
}

Touch SandSide::move(HeightField& bed, const Eigen::Vector3d& read_tip, const Eigen::Vector3d& true_tip,
                     std::optional<double> highest) {
  const Eigen::Vector3d motion = last_tip_ ? Eigen::Vector3d(true_tip - *last_tip_) : Eigen::Vector3d::Zero();
  const double on_the_way =
      displace_between(bed, footprint_, read_tip - motion, read_tip, displacement_, highest);
  Touch touch = look(bed, read_tip);
  touch.displaced_volume = on_the_way;
  if (touch.contact) touch.displaced_volume += displace(bed, footprint_, read_tip.z(), motion, displacement_);
  last_tip_ = true_tip;
  return touch;
}

}  // namespace sandstroke
