#include "sand/displacement.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {
namespace {

/// Weight of a ring cell: the positive filter, and for a drag only its front half; in between, blended by how
/// much of the motion is horizontal, so that a plunge that turns into a drag makes no jump.
class RingWeight {
 public:
  RingWeight(const Eigen::Vector3d& motion, Deposit deposit, double cell_size) : cell_size_(cell_size) {
    const double horizontal = std::hypot(motion.x(), motion.y());
    if (deposit == Deposit::ring || horizontal == 0.0) return;
    direction_ = motion.head<2>() / horizontal;
    drag_share_ = horizontal / (horizontal + std::abs(motion.z()));
  }
  double operator()(const ToolFootprint::Cell& cell) const {
    if (drag_share_ == 0.0) return cell.rampart;
    const double ahead = cell.x * direction_.x() + cell.y * direction_.y();
    return cell.rampart * (1.0 - drag_share_ * (1.0 - std::clamp(ahead / cell_size_ + 0.5, 0.0, 1.0)));
  }

 private:
  double cell_size_;
  double drag_share_ = 0.0;
  Eigen::Vector2d direction_ = Eigen::Vector2d::Zero();
};

double total_weight(const ToolFootprint& footprint, const RingWeight& weight) {
  double sum = 0.0;
  for (const auto& cell : footprint.cells())
    if (cell.in_ring) sum += weight(cell);
  return sum;
}

}  // namespace

double displace(HeightField& bed, const ToolFootprint& footprint, double tip_height,
                const Eigen::Vector3d& motion, const DisplacementSettings& settings) {
  RingWeight weight(motion, settings.deposit, bed.cell_size());
  double weights = total_weight(footprint, weight);
  if (weights <= 0.0 && settings.deposit == Deposit::ahead) {
    // A wall right ahead cuts off the whole front: what is left of the ring takes the sand.
    weight = RingWeight(motion, Deposit::ring, bed.cell_size());
    weights = total_weight(footprint, weight);
  }
  if (weights <= 0.0) return 0.0;

  double pushed = 0.0;  // m: sum of heights taken out
  for (const auto& cell : footprint.cells()) {
    if (!cell.in_bowl) continue;
    const double height = bed(cell.row, cell.col);
    const double excess = height - (tip_height + cell.underside);
    if (excess <= 0.0) continue;
    bed.set(cell.row, cell.col, height - excess);
    pushed += excess;
  }
  if (pushed == 0.0) return 0.0;

  for (const auto& cell : footprint.cells()) {
    if (!cell.in_ring) continue;
    const double share = weight(cell);
    if (share > 0.0) bed.set(cell.row, cell.col, bed(cell.row, cell.col) + pushed * share / weights);
  }
  return pushed * bed.cell_area();
}

}  // namespace sandstroke
