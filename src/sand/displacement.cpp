#include "sand/displacement.h"

#include <cmath>

#include "core/elementary.h"
#include "sand/footprint_kernels.h"

namespace sandstroke {
namespace {

/// The part of the ring that a motion fills. With Deposit::ahead it is the front half for a drag. In between
/// it is blended by the horizontal fraction of the motion, so that a plunge that turns into a drag makes no
/// jump.
RingFront front_of(const Eigen::Vector3d& motion, Deposit deposit) {
  const double horizontal = elementary::hypot(motion.x(), motion.y());
  if (deposit != Deposit::ahead || horizontal == 0.0) return {0.0, Eigen::Vector2d::Zero()};
  return {horizontal / (horizontal + std::abs(motion.z())), motion.head<2>() / horizontal};
}

/// x + shift - shift rounds x to multiples of a quantum. The quantum is such that sums of parts of `whole`
/// are exact, and so the same in any order: a symmetric tool leaves symmetric sand.
double rounding_shift(double whole) { return std::scalbn(3.0, std::ilogb(whole) + 1); }

/// Displaces with any tool but the sphere, which deposits outward only. Returns the sum of heights moved [m].
double displace_any(const HeightField& bed, ToolFootprint& footprint, double tip_height, double distance) {
  const double carved = footprint.carve(tip_height);
  if (carved == 0.0 || !std::isfinite(carved)) return carved;
  const double spread =
      spread_outward(footprint, {distance, rounding_shift(carved), footprint.way_out(distance)});
  if (spread <= 0.0) {
    footprint.read_heights(bed);  // all cells around are tool or wall
    return 0.0;
  }
  deposit(footprint, carved / spread, false);
  return carved;
}

/// Displaces with the sphere. Returns the sum of heights moved [m], 0 if none moved.
double displace_sphere(const HeightField& bed, ToolFootprint& footprint, double tip_height,
                       const Eigen::Vector3d& motion, const DisplacementSettings& settings) {
  if (settings.deposit == Deposit::outward) {
    const double carved = carve(footprint.shape(), footprint, tip_height);
    if (carved == 0.0) return 0.0;
    const Outward outward{settings.distance * footprint.radius(), rounding_shift(carved)};
    const double spread = std::isfinite(carved) ? spread_outward(footprint, outward) : 0.0;
    if (spread > 0.0) {
      deposit(footprint, carved / spread, false);
      return carved;
    }
    footprint.read_heights(bed);  // all cells around are bowl or wall: the ring takes the sand
  }
  const Carved carved =
      carve_for_ring(footprint.shape(), footprint, tip_height, front_of(motion, settings.deposit));
  // A wall right ahead may cut off the whole front; then the rest of the ring takes the sand.
  const bool whole_ring = !(carved.front_weight > 0.0);
  const double weight = whole_ring ? carved.ring_weight : carved.front_weight;
  if (carved.sum == 0.0 || !(weight > 0.0)) return 0.0;
  deposit(footprint, carved.sum / weight, whole_ring);
  return carved.sum;
}

}  // namespace

double displace(HeightField& bed, ToolFootprint& footprint, double tip_height, const Eigen::Vector3d& motion,
                const DisplacementSettings& settings) {
  if (footprint.cells().empty()) return 0.0;
  const double moved = footprint.is_sphere() ? displace_sphere(bed, footprint, tip_height, motion, settings)
                                             : displace_any(bed, footprint, tip_height, settings.distance);
  if (moved > 0.0) footprint.write_flagged(bed);
  return moved * bed.cell_area();
}

}  // namespace sandstroke
