// Sums go over opposite neighbours in pairs, so that a symmetric bed stays symmetric to the bit.
#include "rules/talus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/angle.h"
#include "core/elementary.h"

namespace sandstroke {

double talus_slope(double talus_angle) { return elementary::tan(to_radians(talus_angle)); }

TalusLaw talus_law(RelaxationLaw law, double share, double talus_angle, double tolerance, double cell_size) {
  const double axis = talus_slope(talus_angle) * cell_size, diagonal = axis * std::numbers::sqrt2;
  return {law, share, axis, diagonal, axis * (1.0 + tolerance), diagonal * (1.0 + tolerance)};
}

namespace {

struct Offset {
  int row, col;
};
constexpr std::array<Offset, 4> axis_neighbours = {{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}};
constexpr std::array<Offset, 4> diagonal_neighbours = {{{-1, -1}, {1, 1}, {-1, 1}, {1, -1}}};

double paired_sum(const std::array<double, 4>& terms) {
  return (terms[0] + terms[1]) + (terms[2] + terms[3]);
}

/// The bed as it is before the pass.
class Bed {
 public:
  Bed(const HeightGrid& heights, const WallGrid& walls) : heights_(heights), walls_(walls) {}

  int rows() const { return static_cast<int>(heights_.rows()); }
  int cols() const { return static_cast<int>(heights_.cols()); }
  double height(int row, int col) const { return heights_(row, col); }
  bool is_wall(int row, int col) const {
    return row < 0 || row >= rows() || col < 0 || col >= cols() || walls_(row, col);
  }
  /// By how much a cell stands above its neighbour; -infinity where either is a wall, so that nothing flows.
  double drop(int row, int col, Offset to) const {
    const int r = row + to.row, c = col + to.col;
    if (is_wall(row, col) || is_wall(r, c)) return -std::numeric_limits<double>::infinity();
    return heights_(row, col) - heights_(r, c);
  }
  std::array<double, 4> drops(int row, int col, const std::array<Offset, 4>& neighbours) const {
    std::array<double, 4> drops;
    for (int i = 0; i < 4; ++i) drops[i] = drop(row, col, neighbours[i]);
    return drops;
  }

 private:
  const HeightGrid& heights_;
  const WallGrid& walls_;
};

/// The part of each drop that a cell gives to its lower neighbours; 0 at rest. Raises `residual` to the
/// cell's.
double paper_factor(const Bed& bed, const TalusLaw& law, int row, int col, double& residual) {
  std::array<double, 4> axis = bed.drops(row, col, axis_neighbours),
                        diagonal = bed.drops(row, col, diagonal_neighbours);
  const double axis_max = *std::max_element(axis.begin(), axis.end());
  const double diagonal_max = *std::max_element(diagonal.begin(), diagonal.end());
  residual = std::max({residual, axis_max / law.axis_drop - 1.0, diagonal_max / law.diagonal_drop - 1.0});
  if (!(axis_max > law.axis_limit || diagonal_max > law.diagonal_limit)) return 0.0;
  const double dm = law.share * std::max(axis_max - law.axis_drop, diagonal_max - law.diagonal_drop);
  for (double& one : axis) one = one > law.axis_drop ? one : 0.0;
  for (double& one : diagonal) one = one > law.diagonal_drop ? one : 0.0;
  return dm / (paired_sum(axis) + paired_sum(diagonal));
}

double isotropic_factor(const Bed& bed, const TalusLaw& law, int row, int col, double& residual) {
  const std::array<double, 4> axis = bed.drops(row, col, axis_neighbours);
  const double gx = std::max({0.0, axis[0], axis[1]}), gy = std::max({0.0, axis[2], axis[3]});
  const double slope = std::sqrt(gx * gx + gy * gy);
  residual = std::max(residual, slope / law.axis_drop - 1.0);
  return slope > law.axis_limit ? law.share * (1.0 - law.axis_drop / slope) : 0.0;
}

/// Central difference [m per cell] along `side`, one-sided at walls.
double slope_across(const Bed& bed, int row, int col, Offset side) {
  const bool has_after = !bed.is_wall(row + side.row, col + side.col),
             has_before = !bed.is_wall(row - side.row, col - side.col);
  const double here = bed.height(row, col),
               after = has_after ? bed.height(row + side.row, col + side.col) : here,
               before = has_before ? bed.height(row - side.row, col - side.col) : here;
  return (after - before) * (has_after && has_before ? 0.5 : 1.0);
}

/// The flow from a cell to its neighbour by `faces`; negative the other way.
double face_flow(const Bed& bed, const TalusLaw& law, int row, int col, Offset to, double& residual) {
  const double down = bed.drop(row, col, to);
  if (!std::isfinite(down) || down == 0.0) return 0.0;
  const Offset next{row + to.row, col + to.col}, back{-to.row, -to.col}, side{to.col, to.row};
  const double fall = std::abs(down);
  const double behind = down > 0.0 ? bed.drop(row, col, back) : bed.drop(next.row, next.col, to);
  double along = fall;
  if (behind > 0.0) {
    const double low = std::min(fall, behind), high = std::max(fall, behind);
    along += low * low / (3.0 * high);
  }
  const double across =
      0.5 * (slope_across(bed, row, col, side) + slope_across(bed, next.row, next.col, side));
  const double slope = std::sqrt(along * along + across * across);
  residual = std::max(residual, slope / law.axis_drop - 1.0);
  return slope > law.axis_limit ? law.share * (1.0 - law.axis_drop / slope) * down : 0.0;
}

/// paper and isotropic: each cell gives a part of its drops to its lower neighbours.
TalusPass pass_by_cells(const Bed& bed, const TalusLaw& law, CompensatedSum& moved) {
  const bool paper = law.law == RelaxationLaw::paper;
  TalusPass pass{HeightGrid(bed.rows(), bed.cols()), false, 0.0};
  HeightGrid factors(bed.rows(), bed.cols());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col)
      factors(row, col) = paper ? paper_factor(bed, law, row, col, pass.residual)
                                : isotropic_factor(bed, law, row, col, pass.residual);
  pass.flows = !(factors == 0.0).all();
  if (!pass.flows) return pass;

  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      double out = 0.0, in = 0.0;
      const auto exchange = [&](const std::array<Offset, 4>& neighbours, double threshold) {
        std::array<double, 4> given{}, taken{};
        for (int i = 0; i < 4; ++i) {
          const double down = bed.drop(row, col, neighbours[i]);
          if (!std::isfinite(down)) continue;
          const int r = row + neighbours[i].row, c = col + neighbours[i].col;
          const double up = bed.height(r, c) - bed.height(row, col);
          if (down > threshold) given[i] = factors(row, col) * down;
          if (up > threshold) taken[i] = factors(r, c) * up;
        }
        out += paired_sum(given);
        in += paired_sum(taken);
      };
      exchange(axis_neighbours, paper ? law.axis_drop : 0.0);
      if (paper) exchange(diagonal_neighbours, law.diagonal_drop);
      moved.add(out);
      pass.heights(row, col) = bed.height(row, col) + (in - out);
    }
  return pass;
}

/// faces: sand flows through the faces between cells.
TalusPass pass_by_faces(const Bed& bed, const TalusLaw& law, CompensatedSum& moved) {
  TalusPass pass{HeightGrid(bed.rows(), bed.cols()), false, 0.0};
  HeightGrid right(bed.rows(), bed.cols()), below(bed.rows(), bed.cols());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      right(row, col) = face_flow(bed, law, row, col, {0, 1}, pass.residual);
      below(row, col) = face_flow(bed, law, row, col, {1, 0}, pass.residual);
    }
  pass.flows = !((right == 0.0).all() && (below == 0.0).all());
  if (!pass.flows) return pass;

  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      const double east = right(row, col), west = col > 0 ? right(row, col - 1) : 0.0;
      const double south = below(row, col), north = row > 0 ? below(row - 1, col) : 0.0;
      moved.add((std::max(0.0, east) + std::max(0.0, -west)) +
                (std::max(0.0, south) + std::max(0.0, -north)));
      pass.heights(row, col) = bed.height(row, col) + ((west - east) + (north - south));
    }
  return pass;
}

}  // namespace

TalusPass talus_pass(const HeightGrid& heights, const WallGrid& walls, const TalusLaw& law,
                     CompensatedSum& moved) {
  const Bed bed(heights, walls);
  return law.law == RelaxationLaw::faces ? pass_by_faces(bed, law, moved) : pass_by_cells(bed, law, moved);
}

}  // namespace sandstroke
