#include "sand/displacement.h"

#include <algorithm>
#include <array>
#include <bit>
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

/// Rounds to multiples of a quantum so small and so large that sums of parts of `whole` are exact, and so the
/// same in any order: a symmetric tool leaves symmetric sand.
class ExactSums {
 public:
  explicit ExactSums(double whole) : shift_(std::scalbn(3.0, std::ilogb(whole) + 1)) {}
  double operator()(double part) const { return part + shift_ - shift_; }

 private:
  double shift_;
};

/// Calls visit(row, col) for the cells that the last carve() cut.
template <class Visit>
void for_cut_cells(ToolFootprint& f, const Visit& visit) {
  for (int row = 0; row < f.cells().rows(); ++row)
    for (int group = 0; group < f.stride() / cells_per_group; ++group)
      for (unsigned flags = f.flags(row)[group]; flags != 0; flags &= flags - 1)
        visit(row, group * cells_per_group + std::countr_zero(flags));
}

/// Fills weights() with the cut sand where it goes: each cell's along the tool's outward normal, to
/// `distance` [m] from the axis, shared among the four cells around there (linearly) that are not the bowl's.
/// Sand right on the axis, or with no such cell inside the bed, joins what the others give. Returns the sum.
double spread_outward(ToolFootprint& f, double pushed, double distance) {
  const ExactSums exact(pushed);
  const CellRange& window = f.cells();
  const double axis_x = f.axis_x() - f.first_x(), axis_y = f.axis_y() - f.first_y();  // columns, rows
  for (int row = 0; row < window.rows(); ++row) std::fill_n(f.weights(row), f.stride(), 0.0);
  double total = 0.0;
  for_cut_cells(f, [&](int row, int col) {
    const double x = col - axis_x, y = row - axis_y, from_axis = std::sqrt(x * x + y * y);
    if (from_axis == 0.0) return;
    const double ratio = distance / f.cell_size() / from_axis, to_x = ratio * x, to_y = ratio * y;
    // Rounded towards 0; below 0 that is not down, but no cell of the window lies there.
    const int first_row = static_cast<int>(axis_y + to_y), first_col = static_cast<int>(axis_x + to_x);
    std::array<double, 4> shares{};
    for (int down = 0; down < 2; ++down) {
      const int r = first_row + down;
      if (r < 0 || r >= window.rows()) continue;
      const ColumnRange sand = f.sand_cols(r);
      for (int right = 0; right < 2; ++right) {
        const int c = first_col + right;
        if (c < sand.begin || c >= sand.end || std::isfinite(f.underside(r)[c])) continue;
        shares[2 * down + right] = std::max(0.0, 1.0 - std::abs(c - axis_x - to_x)) *
                                   std::max(0.0, 1.0 - std::abs(r - axis_y - to_y));
      }
    }
    const double all = (shares[0] + shares[3]) + (shares[1] + shares[2]);  // symmetric
    if (!(all > 0.0)) return;
    for (int i = 0; i < 4; ++i) {
      if (shares[i] == 0.0) continue;
      const double part = exact(f.excess(row)[col] * (shares[i] / all));
      f.weights(first_row + i / 2)[first_col + i % 2] += part;
      total += part;
    }
  });
  return total;
}

}  // namespace

double displace(HeightField& bed, ToolFootprint& footprint, double tip_height, const Eigen::Vector3d& motion,
                const DisplacementSettings& settings) {
  if (footprint.cells().empty()) return 0.0;
  Carved carved = carve(footprint, tip_height, front_of(motion, settings.deposit));
  if (settings.deposit == Deposit::outward && carved.pushed > 0.0 && std::isfinite(carved.pushed))
    carved.front_weight = spread_outward(footprint, carved.pushed, settings.distance * footprint.radius());
  // A wall right ahead may cut off the whole front: what is left of the ring takes the sand.
  const bool whole_ring = !(carved.front_weight > 0.0);
  const double weight = whole_ring ? carved.ring_weight : carved.front_weight;
  if (carved.pushed == 0.0 || !(weight > 0.0)) return 0.0;
  heap(footprint, carved.pushed / weight, whole_ring);
  footprint.write_flagged(bed);
  return carved.pushed * bed.cell_area();
}

}  // namespace sandstroke
