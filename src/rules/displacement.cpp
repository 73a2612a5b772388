#include "rules/displacement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"

namespace sandstroke {
namespace {

/// A sum in eight parts by column: the order of the kernels, and so their bits.
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

}  // namespace

PlainDisplacement::PlainDisplacement(ToolProfile profile, double radius, const WallGrid& walls,
                                     double cell_size, double x, double y)
    : profile_(profile),
      radius_(radius),
      walls_(walls),
      cell_size_(cell_size),
      row_origin_(0.5 * static_cast<double>(walls.rows() - 1)),
      col_origin_(0.5 * static_cast<double>(walls.cols() - 1)),
      axis_x_(x / cell_size),
      axis_y_(y / cell_size),
      row_end_(static_cast<int>(walls.rows())),
      col_end_(static_cast<int>(walls.cols())) {
  const double extent = filter::reach(radius) / cell_size + 1.0;
  while (row_begin_ < row_end_ && row_begin_ - row_origin_ < axis_y_ - extent) ++row_begin_;
  while (row_begin_ < row_end_ && row_end_ - 1 - row_origin_ > axis_y_ + extent) --row_end_;
  while (col_begin_ < col_end_ && col_begin_ - col_origin_ < axis_x_ - extent) ++col_begin_;
  while (col_begin_ < col_end_ && col_end_ - 1 - col_origin_ > axis_x_ + extent) --col_end_;
}

template <class Visit>
void PlainDisplacement::for_cells(const Visit& visit) const {
  for (int row = row_begin_; row < row_end_; ++row)
    for (int col = col_begin_; col < col_end_; ++col) visit(row, col);
}

double PlainDisplacement::rho2(int row, int col) const {
  if (walls_(row, col)) return std::numeric_limits<double>::infinity();
  return x_of(col) * x_of(col) + y_of(row) * y_of(row);
}

template <class Height>
double PlainDisplacement::mean_under(const Height& height_of) const {
  SumOfColumns sum, weights;
  for_cells([&](int row, int col) {
    const double inside = filter::reach(radius_) - std::sqrt(rho2(row, col));
    const double weight = std::clamp(inside / cell_size_ + 1.0, 0.0, 1.0);
    sum.add(col - col_begin_, weight * height_of(row, col));
    weights.add(col - col_begin_, weight);
  });
  return sum.total() / weights.total();
}

double PlainDisplacement::sand_level(const HeightGrid& heights) const {
  return mean_under([&](int row, int col) { return heights(row, col); });
}

double PlainDisplacement::floor_above(const HeightGrid& floor, double tip_height) const {
  return mean_under([&](int row, int col) { return std::max(floor(row, col) - tip_height, 0.0); });
}

double PlainDisplacement::displace(HeightGrid& heights, double tip_height, const Eigen::Vector3d& motion,
                                   const DisplacementSettings& settings, const HeightGrid* floor) const {
  const auto floor_at = [&](int row, int col) {
    return floor ? (*floor)(row, col) : -std::numeric_limits<double>::infinity();
  };
  const auto underside = [&](int row, int col) {
    return tip_height + filter::underside(profile_, radius_, rho2(row, col));
  };
  const auto is_open = [&](int row, int col) { return !(floor_at(row, col) > tip_height + radius_); };
  HeightGrid excess = HeightGrid::Zero(row_end_ - row_begin_, col_end_ - col_begin_), ring = excess,
             weights = excess;  // of the window
  SumOfColumns taken, on_ring, on_part;
  for_cells([&](int row, int col) {
    const int r = row - row_begin_, c = col - col_begin_;
    const double lowest = std::max(underside(row, col), floor_at(row, col));
    excess(r, c) = std::max(0.0, heights(row, col) - lowest);
    weights(r, c) = ring(r, c) = is_open(row, col) ? filter::positive(u(row, col)) : 0.0;
    if (settings.deposit == Deposit::ahead) weights(r, c) *= fraction_ahead(row, col, motion);
    taken.add(c, excess(r, c));
    on_ring.add(c, ring(r, c));
    on_part.add(c, weights(r, c));
  });
  const double V = taken.total();
  if (V == 0.0) return 0.0;
  double sum = on_part.total();
  if (settings.deposit == Deposit::outward) {
    weights = spread_outward(excess, V, settings.distance, is_open);
    sum = weights.sum();  // exact, in any order
  }
  if (sum == 0.0) {  // a wall is in the way
    weights = ring;
    sum = on_ring.total();
  }
  if (sum == 0.0) return 0.0;
  for_cells([&](int row, int col) {
    const int r = row - row_begin_, c = col - col_begin_;
    // To the floor exactly, where the tool goes there: the difference is rounded.
    const double bare = floor_at(row, col), left = heights(row, col) - excess(r, c);
    if (excess(r, c) > 0.0) heights(row, col) = bare >= underside(row, col) ? bare : std::max(left, bare);
    if (weights(r, c) > 0.0) heights(row, col) += V / sum * weights(r, c);
  });
  return V * (cell_size_ * cell_size_);
}

/// `ahead`: a drag deposits on the ring's front half only. The fraction follows how much of the motion is
/// horizontal, so that a plunge that turns into a drag makes no jump.
double PlainDisplacement::fraction_ahead(int row, int col, const Eigen::Vector3d& motion) const {
  const double drag = elementary::hypot(motion.x(), motion.y());
  if (drag == 0.0) return 1.0;
  const double ahead = x_of(col) * (motion.x() / drag) + y_of(row) * (motion.y() / drag);
  const double horizontal = drag / (drag + std::abs(motion.z()));
  return 1.0 - horizontal * (1.0 - std::clamp(ahead / cell_size_ + 0.5, 0.0, 1.0));
}

/// `outward`: what each cell's sand brings to the four cells around the point `distance` radii from the axis.
/// It goes in three parts, side by side round the axis.
template <class IsOpen>
HeightGrid PlainDisplacement::spread_outward(const HeightGrid& excess, double taken, double distance,
                                             const IsOpen& is_open) const {
  const double quantum = std::ldexp(1.0, std::ilogb(taken) - 50);  // its multiples add up exactly
  const double axis_x = axis_x_ - (col_begin_ - col_origin_),      // cells, from the window's first
      axis_y = axis_y_ - (row_begin_ - row_origin_);
  HeightGrid weights = HeightGrid::Zero(excess.rows(), excess.cols());
  const auto takes = [&](int r, int c) {
    return r >= 0 && r < weights.rows() && c >= 0 && c < weights.cols() &&
           !walls_(row_begin_ + r, col_begin_ + c) && !covers(row_begin_ + r, col_begin_ + c) &&
           is_open(row_begin_ + r, col_begin_ + c);
  };
  const auto part = [&](int row, int col, double aside) {
    const double x = col - axis_x, y = row - axis_y, rho = std::sqrt(x * x + y * y);
    if (rho == 0.0) return;
    const double turn = aside / rho, from_x = x - turn * y, from_y = y + turn * x;
    const double ratio = distance * radius_ / cell_size_ / std::sqrt(from_x * from_x + from_y * from_y);
    const double to_x = ratio * from_x, to_y = ratio * from_y;
    const int r0 = static_cast<int>(std::floor(axis_y + to_y)),
              c0 = static_cast<int>(std::floor(axis_x + to_x));
    // By the distance to the cell's centre, along x and along y.
    const auto corner_weight = [&](int r, int c) {
      if (!takes(r, c)) return 0.0;
      return std::max(0.0, 1.0 - std::abs(c - axis_x - to_x)) *
             std::max(0.0, 1.0 - std::abs(r - axis_y - to_y));
    };
    const double all = (corner_weight(r0, c0) + corner_weight(r0 + 1, c0 + 1)) +
                       (corner_weight(r0, c0 + 1) + corner_weight(r0 + 1, c0));
    for (int r = r0; r <= r0 + 1; ++r)
      for (int c = c0; c <= c0 + 1; ++c)
        if (corner_weight(r, c) > 0.0)
          weights(r, c) +=
              std::nearbyint(excess(row, col) / 3.0 * (corner_weight(r, c) / all) / quantum) * quantum;
  };
  for (int row = 0; row < weights.rows(); ++row)
    for (int col = 0; col < weights.cols(); ++col)
      for (const double aside : {-1.0 / 3.0, 0.0, 1.0 / 3.0})  // cells
        if (excess(row, col) > 0.0) part(row, col, aside);
  return weights;
}

}  // namespace sandstroke
