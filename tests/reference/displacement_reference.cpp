#include "reference/displacement_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandstroke {
namespace {

const double u0 = std::asin(0.53);
constexpr double u1 = 1.195907635584353;  // 1 - cos(u1) = 0.53 u1

/// sin(u) for u <= u1: its series. (The last bit of std::sin is the library's own.)
double sine(double u) {
  double sum = 0.0, factorial = 355687428096000.0;  // 17!
  for (int k = 17; k >= 3; factorial /= k * (k - 1), k -= 2)
    sum = sum * (u * u) + (k % 4 == 1 ? 1.0 : -1.0) / factorial;
  return u + u * (u * u * sum);
}

/// A sum in eight parts, by column: the order of the engine's, and so its bits.
class SumOfColumns {
 public:
  void add(int col, double term) { parts_[col % 8] += term; }
  double total() const {
    const double* p = parts_;
    return ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7]));
  }

 private:
  double parts_[8] = {};
};

template <class Visit>
void for_cells(const CellRange& cells, const Visit& visit) {
  for (int row = cells.row_begin; row < cells.row_end; ++row)
    for (int col = cells.col_begin; col < cells.col_end; ++col)
      visit(row, col, row - cells.row_begin, col - cells.col_begin);
}

}  // namespace

DisplacementReference::DisplacementReference(const ToolSettings& tool, const BedGeometry& bed, double x,
                                             double y)
    : tool_(tool),
      bed_(bed),
      axis_x_(x / bed.cell_size()),
      axis_y_(y / bed.cell_size()),
      cells_(bed.cells()) {
  const double rho1 = tool.radius * std::sqrt(u1 / u0), extent = rho1 / bed.cell_size() + 1.0;
  while (!cells_.empty() && bed.rows_from_centre(cells_.row_begin) < axis_y_ - extent) ++cells_.row_begin;
  while (!cells_.empty() && bed.rows_from_centre(cells_.row_end - 1) > axis_y_ + extent) --cells_.row_end;
  while (!cells_.empty() && bed.cols_from_centre(cells_.col_begin) < axis_x_ - extent) ++cells_.col_begin;
  while (!cells_.empty() && bed.cols_from_centre(cells_.col_end - 1) > axis_x_ + extent) --cells_.col_end;
}

double DisplacementReference::rho2(int row, int col) const {
  if (!bed_.has_sand(row, col)) return std::numeric_limits<double>::infinity();
  return x_of(col) * x_of(col) + y_of(row) * y_of(row);
}
double DisplacementReference::u(int row, int col) const {
  return rho2(row, col) / (tool_.radius * tool_.radius / u0);
}
bool DisplacementReference::in_bowl(int row, int col) const { return u(row, col) <= u0; }

double DisplacementReference::underside(int row, int col) const {
  if (!in_bowl(row, col)) return std::numeric_limits<double>::infinity();
  const double R = tool_.radius;
  if (tool_.profile == ToolProfile::paper) return R / (2.0 * u0) * sine(u(row, col));
  return R - std::sqrt(std::max(R * R - rho2(row, col), 0.0));
}

double DisplacementReference::positive_filter(int row, int col) const {
  const bool in_ring = !in_bowl(row, col) && u(row, col) <= u1;
  return in_ring ? std::max(sine(u(row, col)) - 0.53, 0.0) : 0.0;
}

double DisplacementReference::sand_level(const HeightField& sand) const {
  const double rho1 = tool_.radius * std::sqrt(u1 / u0);
  SumOfColumns heights, weights;
  for_cells(cells_, [&](int row, int col, int, int c) {
    const double weight = std::clamp((rho1 - std::sqrt(rho2(row, col))) / bed_.cell_size() + 1.0, 0.0, 1.0);
    heights.add(c, weight * sand(row, col));
    weights.add(c, weight);
  });
  return heights.total() / weights.total();
}

double DisplacementReference::displace(HeightField& sand, double tip_height, const Eigen::Vector3d& motion,
                                       const DisplacementSettings& settings) const {
  const double drag = std::hypot(motion.x(), motion.y());
  const double m =
      settings.deposit == Deposit::ahead && drag > 0.0 ? drag / (drag + std::abs(motion.z())) : 0.0;
  HeightGrid excess = HeightGrid::Zero(cells_.rows(), cells_.cols()), ring = excess, weights = excess;
  SumOfColumns pushed, sum_of_ring, sum_of_ahead;
  for_cells(cells_, [&](int row, int col, int r, int c) {
    excess(r, c) = std::max(0.0, sand(row, col) - (tip_height + underside(row, col)));
    weights(r, c) = ring(r, c) = positive_filter(row, col);
    if (m > 0.0) {
      const double p = x_of(col) * (motion.x() / drag) + y_of(row) * (motion.y() / drag);
      weights(r, c) *= 1.0 - m * (1.0 - std::clamp(p / bed_.cell_size() + 0.5, 0.0, 1.0));
    }
    pushed.add(c, excess(r, c));
    sum_of_ring.add(c, ring(r, c));
    sum_of_ahead.add(c, weights(r, c));
  });
  const double V = pushed.total();
  double sum = sum_of_ahead.total();
  if (V == 0.0) return 0.0;
  if (settings.deposit == Deposit::outward) {
    weights = outward(excess, V, settings.distance);
    sum = weights.sum();  // exact, in any order
  }
  if (sum == 0.0) weights = ring, sum = sum_of_ring.total();  // a wall is in the way
  if (sum == 0.0) return 0.0;
  for_cells(cells_, [&](int row, int col, int r, int c) {
    if (excess(r, c) > 0.0) sand.set(row, col, sand(row, col) - excess(r, c));
    if (weights(r, c) > 0.0) sand.set(row, col, sand(row, col) + V / sum * weights(r, c));
  });
  return V * bed_.cell_area();
}

/// What each cell's sand brings to those around the place `distance` radii from the axis, straight outward.
HeightGrid DisplacementReference::outward(const HeightGrid& excess, double pushed, double distance) const {
  const double quantum = std::ldexp(1.0, std::ilogb(pushed) - 50);  // its multiples add up exactly
  // In cells, from the first of cells_.
  const double axis_x = axis_x_ - bed_.cols_from_centre(cells_.col_begin),
               axis_y = axis_y_ - bed_.rows_from_centre(cells_.row_begin);
  HeightGrid weights = HeightGrid::Zero(excess.rows(), excess.cols());
  for (int row = 0; row < cells_.rows(); ++row)
    for (int col = 0; col < cells_.cols(); ++col)
      for (const double aside :
           {-1.0 / 3.0, 0.0, 1.0 / 3.0}) {  // thirds of a cell, side by side round the axis
        const double x = col - axis_x, y = row - axis_y, rho = std::sqrt(x * x + y * y);
        if (excess(row, col) == 0.0 || rho == 0.0) continue;
        const double turn = aside / rho, from_x = x - turn * y, from_y = y + turn * x;
        const double ratio =
            distance * tool_.radius / bed_.cell_size() / std::sqrt(from_x * from_x + from_y * from_y);
        const double to_x = ratio * from_x, to_y = ratio * from_y;
        const int r0 = static_cast<int>(std::floor(axis_y + to_y)),
                  c0 = static_cast<int>(std::floor(axis_x + to_x));
        const auto share = [&](int r, int c) {  // by the distance to a cell's centre, along x and along y
          const bool free = r >= 0 && r < cells_.rows() && c >= 0 && c < cells_.cols() &&
                            bed_.has_sand(cells_.row_begin + r, cells_.col_begin + c) &&
                            !in_bowl(cells_.row_begin + r, cells_.col_begin + c);
          return free ? std::max(0.0, 1.0 - std::abs(c - axis_x - to_x)) *
                            std::max(0.0, 1.0 - std::abs(r - axis_y - to_y))
                      : 0.0;
        };
        const double all = (share(r0, c0) + share(r0 + 1, c0 + 1)) + (share(r0, c0 + 1) + share(r0 + 1, c0));
        for (int r = r0; r <= r0 + 1; ++r)
          for (int c = c0; c <= c0 + 1; ++c)
            if (share(r, c) > 0.0)
              weights(r, c) +=
                  std::nearbyint(excess(row, col) / 3.0 * (share(r, c) / all) / quantum) * quantum;
      }
  return weights;
}

}  // namespace sandstroke
