#include "sand/displacement.h"

#include <cmath>

#include "sand/footprint_kernels.h"

namespace sandstroke {
namespace {

/// For a drag only the ring's front half; in between, blended by how much of the motion is horizontal, so
/// that a plunge that turns into a drag makes no jump.
RingFront front_of(const Eigen::Vector3d& motion, Deposit deposit) {
  const double horizontal = std::hypot(motion.x(), motion.y());
  if (deposit != Deposit::ahead || horizontal == 0.0) return {0.0, Eigen::Vector2d::Zero()};
  return {horizontal / (horizontal + std::abs(motion.z())), motion.head<2>() / horizontal};
}

/// Adding and taking away again what this returns rounds to multiples of a quantum so small and so large that
/// sums of parts of `whole` are exact, and so the same in any order: a symmetric tool leaves symmetric sand.
double rounding_shift(double whole) { return std::scalbn(3.0, std::ilogb(whole) + 1); }

}  // namespace

double displace(HeightField& bed, ToolFootprint& footprint, double tip_height, const Eigen::Vector3d& motion,
                const DisplacementSettings& settings) {
  if (footprint.cells().empty()) return 0.0;
  footprint.shape_bowl();
  const double pushed = carve(footprint, tip_height);
  if (pushed == 0.0) return 0.0;
  double weight = 0.0;
  bool whole_ring = false;
  if (settings.deposit == Deposit::outward && std::isfinite(pushed))
    weight = spread_outward(footprint, {settings.distance * footprint.radius(), rounding_shift(pushed)});
  if (!(weight > 0.0)) {
    footprint.shape_ring();
    const RingWeight ring = weigh_ring(footprint, front_of(motion, settings.deposit));
    // A wall right ahead may cut off the whole front: what is left of the ring takes the sand.
    whole_ring = !(ring.front > 0.0);
    weight = whole_ring ? ring.whole : ring.front;
  }
  if (!(weight > 0.0)) return 0.0;
  heap(footprint, pushed / weight, whole_ring);
  footprint.write_flagged(bed);
  return pushed * bed.cell_area();
}

}  // namespace sandstroke
