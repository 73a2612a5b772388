#include "bench/peers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace sandstroke {
namespace {

double axis_drop(const HeightField& bed, double talus_angle) {
  return talus_slope(talus_angle) * bed.cell_size();
}

/// Four neighbours, until all is at rest: where two cells that share a side differ by more than the talus
/// allows, half of the excess changes sides at once, pair after pair in the order of the rows. (The rule of
/// soil_dynamics_cpp, and of the bulldozing in Chrono's deformable terrain.) It knows only the slopes along
/// the axes, so what it calls at rest is a pyramid, 39 degrees steep between the axes where 30 are set.
RelaxationOutcome four_neighbours(HeightField& bed, double talus_angle) {
  HeightGrid h = bed.grid();
  const double drop = axis_drop(bed, talus_angle), limit = drop * (1.0 + RelaxationSettings{}.tolerance);
  RelaxationOutcome outcome;
  double moved = 0.0;
  const auto settle = [&](double& a, double& b) {
    const double difference = a - b;
    if (std::abs(difference) <= limit) return false;
    const double amount = 0.5 * (std::abs(difference) - drop);
    a -= std::copysign(amount, difference), b += std::copysign(amount, difference);
    moved += amount;
    return true;
  };
  for (bool flows = true; flows;) {
    flows = false;
    for (Eigen::Index row = 0; row < h.rows(); ++row)
      for (Eigen::Index col = 0; col < h.cols(); ++col) {
        if (col + 1 < h.cols()) flows |= settle(h(row, col), h(row, col + 1));
        if (row + 1 < h.rows()) flows |= settle(h(row, col), h(row + 1, col));
      }
    outcome.passes += flows;
    outcome.cells_visited += h.size();
  }
  bed = HeightField(h, bed.cell_size());
  outcome.moved_volume = moved * bed.cell_area();
  outcome.converged = true;
  return outcome;
}

/// Eight neighbours, a fixed number of Jacobi passes: a cell gives half of its largest excess over the talus
/// to the lower neighbours, in proportion to their excess. (Thermal erosion as Musgrave, Kolb & Mace,
/// SIGGRAPH 1989, and Olsen, 2004, describe it, and terrain tools ship it: the user chooses the number.)
RelaxationOutcome half_the_excess(HeightField& bed, double talus_angle, int count) {
  HeightGrid h = bed.grid(), next = h;
  const double axis = axis_drop(bed, talus_angle);
  RelaxationOutcome outcome;
  double moved = 0.0;
  for (; outcome.passes < count; ++outcome.passes) {
    for (Eigen::Index row = 0; row < h.rows(); ++row)
      for (Eigen::Index col = 0; col < h.cols(); ++col) {
        double largest = 0.0, total = 0.0;
        const auto visit_neighbours = [&](const auto& visit) {
          for (Eigen::Index i = std::max<Eigen::Index>(row - 1, 0); i <= std::min(row + 1, h.rows() - 1); ++i)
            for (Eigen::Index j = std::max<Eigen::Index>(col - 1, 0); j <= std::min(col + 1, h.cols() - 1);
                 ++j) {
              const double drop = i != row && j != col ? std::numbers::sqrt2 * axis : axis;
              const double excess = h(row, col) - h(i, j) - drop;
              if (excess > 0.0) visit(next(i, j), excess);
            }
        };
        visit_neighbours([&](double&, double excess) {
          largest = std::max(largest, excess);
          total += excess;
        });
        if (largest == 0.0) continue;
        visit_neighbours(
            [&](double& neighbour, double excess) { neighbour += 0.5 * largest * excess / total; });
        next(row, col) -= 0.5 * largest;
        moved += 0.5 * largest;
      }
    h = next;
    outcome.cells_visited += h.size();
  }
  bed = HeightField(h, bed.cell_size());
  outcome.moved_volume = moved * bed.cell_area();
  outcome.converged = false;  // it does not look
  return outcome;
}

Peer jacobi(int count) {
  return {fmt::format("peers: half the excess, {} passes", count),
          [count](HeightField& bed, double talus_angle) { return half_the_excess(bed, talus_angle, count); }};
}

}  // namespace

std::vector<Peer> published_peers() {
  return {{"peers: 4 neighbours", four_neighbours}, jacobi(50), jacobi(500)};
}

}  // namespace sandstroke
