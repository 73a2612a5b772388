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

struct Offset {
  Eigen::Index row, col;
};

/// Pairs of cells that share a side, until all are at rest: where the two differ by more than the talus
/// allows, this share of the excess changes sides at once, pair after pair in the order of the rows. Such a
/// rule knows only the slopes along the axes, so what it calls at rest is a pyramid, 39 degrees steep between
/// the axes where 30 are set.
RelaxationOutcome settle_pairs(HeightField& bed, double talus_angle, double share,
                               const std::vector<Offset>& neighbours) {
  HeightGrid h = bed.grid();
  const double drop = axis_drop(bed, talus_angle), limit = drop * (1.0 + RelaxationSettings{}.tolerance);
  RelaxationOutcome outcome;
  double moved = 0.0;
  const auto settle = [&](double& a, double& b) {
    const double difference = a - b;
    if (std::abs(difference) <= limit) return false;
    const double amount = share * (std::abs(difference) - drop);
    a -= std::copysign(amount, difference);
    b += std::copysign(amount, difference);
    moved += amount;
    return true;
  };
  for (bool flows = true; flows;) {
    flows = false;
    for (Eigen::Index row = 0; row < h.rows(); ++row)
      for (Eigen::Index col = 0; col < h.cols(); ++col)
        for (const Offset& offset : neighbours) {
          const Eigen::Index i = row + offset.row, j = col + offset.col;
          if (i >= 0 && i < h.rows() && j >= 0 && j < h.cols()) flows |= settle(h(row, col), h(i, j));
        }
    outcome.passes += flows;
    outcome.cells_visited += h.size();
  }
  bed = HeightField(h, bed.cell_size());
  outcome.moved_volume = moved * bed.cell_area();
  outcome.converged = true;
  return outcome;
}

/// Each pair once, half of its excess: the rule of soil_dynamics_cpp.
RelaxationOutcome four_neighbours(HeightField& bed, double talus_angle) {
  return settle_pairs(bed, talus_angle, 0.5, {{0, 1}, {1, 0}});
}

/// Each pair from both of its cells, an eighth of its excess each time: the erosion at the end of bulldozing
/// in Chrono's SCMTerrain (SetBulldozingParameters says what there is to set). There three iterations follow
/// a step, on the cells around the tool and in the order of a hash table; here they go on, over the whole
/// field.
RelaxationOutcome scm_erosion(HeightField& bed, double talus_angle) {
  return settle_pairs(bed, talus_angle, 0.125, {{-1, 0}, {1, 0}, {0, -1}, {0, 1}});
}

/// A cell gives to those of its eight neighbours that are too low, in proportion to their excess over the
/// talus (a drop of `axis` along the axes): amount(largest excess, sum of them) in all, which is returned.
template <typename Amount>
double give(const HeightGrid& from, HeightGrid& to, Eigen::Index row, Eigen::Index col, double axis,
            const Amount& amount) {
  const auto visit_lower = [&](const auto& visit) {
    for (Eigen::Index i = std::max<Eigen::Index>(row - 1, 0); i <= std::min(row + 1, from.rows() - 1); ++i)
      for (Eigen::Index j = std::max<Eigen::Index>(col - 1, 0); j <= std::min(col + 1, from.cols() - 1);
           ++j) {
        const double drop = i != row && j != col ? std::numbers::sqrt2 * axis : axis;
        const double excess = from(row, col) - from(i, j) - drop;
        if (excess > 0.0) visit(to(i, j), excess);
      }
  };
  double largest = 0.0, total = 0.0;
  visit_lower([&](double&, double excess) {
    largest = std::max(largest, excess);
    total += excess;
  });
  if (largest == 0.0) return 0.0;
  const double given = amount(largest, total);
  visit_lower([&](double& neighbour, double excess) { neighbour += given * excess / total; });
  to(row, col) -= given;
  return given;
}

/// Eight neighbours, a fixed number of Jacobi passes: a cell gives half of its largest excess. (Thermal
/// erosion as Musgrave, Kolb & Mace, SIGGRAPH 1989, and Olsen, 2004, describe it, and terrain tools ship it:
/// the user chooses the number.)
RelaxationOutcome half_the_excess(HeightField& bed, double talus_angle, int count) {
  HeightGrid h = bed.grid(), next = h;
  const double axis = axis_drop(bed, talus_angle);
  RelaxationOutcome outcome;
  double moved = 0.0;
  for (; outcome.passes < count; ++outcome.passes) {
    for (Eigen::Index row = 0; row < h.rows(); ++row)
      for (Eigen::Index col = 0; col < h.cols(); ++col)
        moved += give(h, next, row, col, axis, [](double largest, double) { return 0.5 * largest; });
    h = next;
    outcome.cells_visited += h.size();
  }
  bed = HeightField(h, bed.cell_size());
  outcome.moved_volume = moved * bed.cell_area();
  outcome.converged = false;  // it does not look
  return outcome;
}

/// Eight neighbours, frames of 50 passes in place: a cell gives largest / (1 + largest / sum), after which
/// its steepest slope is the talus, or half of that in every tenth pass and in the last five. (The
/// avalanching of CUDA-Dune-Simulation by its defaults; Nilles, Guenther & Mueller, Real-Time Desertscapes
/// Simulation with CUDA, 2024. There the threads of a GPU meet in any order; here cells go row by row.)
RelaxationOutcome avalanches(HeightField& bed, double talus_angle, int frames) {
  constexpr int passes = 50, soft_every = 10, soft_at_end = 5;
  HeightGrid h = bed.grid();
  const double axis = axis_drop(bed, talus_angle);
  RelaxationOutcome outcome;
  double moved = 0.0;
  for (; outcome.passes < frames * passes; ++outcome.passes) {
    const int pass = static_cast<int>(outcome.passes % passes);
    const double strength = pass % soft_every == 0 || pass >= passes - soft_at_end ? 0.5 : 1.0;
    for (Eigen::Index row = 0; row < h.rows(); ++row)
      for (Eigen::Index col = 0; col < h.cols(); ++col)
        moved += give(h, h, row, col, axis, [strength](double largest, double total) {
          return strength * largest / (1.0 + largest / total);
        });
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

Peer dunes(int frames) {
  return {fmt::format("peers: avalanches, {} passes", 50 * frames),
          [frames](HeightField& bed, double talus_angle) { return avalanches(bed, talus_angle, frames); }};
}

}  // namespace

std::vector<Peer> published_peers() {
  return {{"peers: 4 neighbours", four_neighbours},
          {"peers: SCM erosion", scm_erosion},
          jacobi(50),
          jacobi(500),
          dunes(1),
          dunes(10)};
}

}  // namespace sandstroke
