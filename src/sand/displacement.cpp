#include "sand/displacement.h"

#include <cmath>

#include "sand/footprint_kernels.h"

namespace sandstroke {
namespace {

/// For a drag only the ring's front half; in between, blended by how much of the motion is horizontal, so
/// that a plunge that turns into a drag makes no jump.
RingFront front_of(const Eigen::Vector3d& motion, Deposit deposit) {
  const double horizontal = std::hypot(motion.x(), motion.y());
  if (deposit == Deposit::ring || horizontal == 0.0) return {0.0, Eigen::Vector2d::Zero()};
  return {horizontal / (horizontal + std::abs(motion.z())), motion.head<2>() / horizontal};
}

}  // namespace

double displace(HeightField& bed, ToolFootprint& footprint, double tip_height, const Eigen::Vector3d& motion,
                const DisplacementSettings& settings) {
  if (footprint.cells().empty()) return 0.0;
  const Carved carved = carve(footprint, tip_height, front_of(motion, settings.deposit));
  // A wall right ahead may cut off the whole front: what is left of the ring takes the sand.
  const bool whole_ring = !(carved.front_weight > 0.0);
  const double weight = whole_ring ? carved.ring_weight : carved.front_weight;
  if (carved.pushed == 0.0 || !(weight > 0.0)) return 0.0;
  heap(footprint, carved.pushed / weight, whole_ring);
  footprint.write_flagged(bed);
  return carved.pushed * bed.cell_area();
}

}  // namespace sandstroke
