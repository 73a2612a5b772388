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
  const double tolerated = 1.0 + tolerance;
  return {.law = law,
          .share = share,
          .axis_drop = axis,
          .diagonal_drop = diagonal,
          .axis_limit = axis * tolerated,
          .diagonal_limit = diagonal * tolerated,
          .tolerated = tolerated,
          .thinnest = std::ldexp(cell_size, -32)};
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
  Bed(const HeightGrid& heights, const WallGrid& walls, const TalusGround* ground, const TalusLaw& law)
      : heights_(heights), walls_(walls), ground_(ground), law_(law) {}

  const TalusLaw& law() const { return law_; }
  int rows() const { return static_cast<int>(heights_.rows()); }
  int cols() const { return static_cast<int>(heights_.cols()); }
  double height(int row, int col) const { return heights_(row, col); }
  bool is_wall(int row, int col) const {
    return row < 0 || row >= rows() || col < 0 || col >= cols() || walls_(row, col);
  }
  /// By how much a cell stands above its neighbour; -infinity where either is a wall, so that nothing flows.
  double drop(int row, int col, Offset to) const {
    const int r = row + to.row, c = col + to.col;
    if (is_wall(row, col) || is_wall(r, c)) return -infinity;
    return heights_(row, col) - heights_(r, c);
  }
  std::array<double, 4> drops(int row, int col, const std::array<Offset, 4>& neighbours) const {
    std::array<double, 4> drops;
    for (int i = 0; i < 4; ++i) drops[i] = drop(row, col, neighbours[i]);
    return drops;
  }
  /// T of a cell and its axis neighbour, or of a diagonal one in units of the distance.
  double axis_drop(int row, int col, Offset to) const {
    const int r = row + to.row, c = col + to.col;
    if (!ground_ || is_wall(r, c)) return law_.axis_drop;
    return 0.5 * (ground_->axis_drops(row, col) + ground_->axis_drops(r, c));
  }
  /// By what a drop to an axis neighbour is multiplied, so that it may be as large as the law's T.
  double weight(int row, int col, Offset to) const { return law_.axis_drop / axis_drop(row, col, to); }
  /// z: how much sand a cell has [m].
  double sand(int row, int col) const {
    return ground_ ? heights_(row, col) - ground_->floor(row, col) : infinity;
  }
  bool has_sand(int row, int col) const { return sand(row, col) > law_.thinnest; }
  /// The height after a gain [m]. Rounding takes no sand below the floor.
  double gained(int row, int col, double gain) const {
    const double height = heights_(row, col) + gain;
    return ground_ ? std::max(height, ground_->floor(row, col)) : height;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  const HeightGrid& heights_;
  const WallGrid& walls_;
  const TalusGround* ground_;
  const TalusLaw& law_;
};

/// The part of each drop that a cell gives to its lower neighbours; 0 at rest. Raises `residual` to the
/// cell's.
double paper_factor(const Bed& bed, int row, int col, double& residual) {
  const TalusLaw& law = bed.law();
  bool flows = false;
  double steepest = -1.0, excess = 0.0;
  const auto sum_of = [&](const std::array<Offset, 4>& neighbours, double distance) {
    std::array<double, 4> drops = bed.drops(row, col, neighbours);
    for (int i = 0; i < 4; ++i) {
      const double T = bed.axis_drop(row, col, neighbours[i]) * distance;
      steepest = std::max(steepest, drops[i] / T - 1.0);
      flows |= drops[i] > T * law.tolerated;
      excess = std::max(excess, drops[i] - T);
      drops[i] = drops[i] > T ? drops[i] : 0.0;
    }
    return paired_sum(drops);
  };
  const double axis = sum_of(axis_neighbours, 1.0),
               diagonal = sum_of(diagonal_neighbours, std::numbers::sqrt2);
  residual = std::max(residual, steepest);
  if (!flows) return 0.0;
  return std::min(law.share * excess, law.most_given * bed.sand(row, col)) / (axis + diagonal);
}

double isotropic_factor(const Bed& bed, int row, int col, double& residual) {
  const TalusLaw& law = bed.law();
  const std::array<double, 4> drops = bed.drops(row, col, axis_neighbours);
  std::array<double, 4> slopes;
  for (int i = 0; i < 4; ++i) slopes[i] = drops[i] * bed.weight(row, col, axis_neighbours[i]);
  const double gx = std::max({0.0, slopes[0], slopes[1]}), gy = std::max({0.0, slopes[2], slopes[3]});
  const double slope = std::sqrt(gx * gx + gy * gy);
  residual = std::max(residual, slope / law.axis_drop - 1.0);
  if (!(slope > law.axis_limit)) return 0.0;
  std::array<double, 4> given;
  for (int i = 0; i < 4; ++i) given[i] = std::max(0.0, drops[i]);
  return std::min(law.share * (1.0 - law.axis_drop / slope),
                  law.most_given * bed.sand(row, col) / paired_sum(given));
}

/// Central difference [m per cell] along `side`, one-sided at walls, as if T were the law's. A height counts
/// as higher than its neighbour by at most twice its own sand.
double slope_across(const Bed& bed, int row, int col, Offset side) {
  const double here = bed.height(row, col);
  const auto beside = [&](int r, int c) {
    const double there = bed.height(r, c);
    const double counted = there > here ? std::min(there, here + 2.0 * bed.sand(r, c))
                                        : std::max(there, here - 2.0 * bed.sand(row, col));
    const double weight = bed.weight(row, col, {r - row, c - col});
    return weight == 1.0 ? counted : here + (counted - here) * weight;
  };
  const bool has_after = !bed.is_wall(row + side.row, col + side.col),
             has_before = !bed.is_wall(row - side.row, col - side.col);
  const double after = has_after ? beside(row + side.row, col + side.col) : here,
               before = has_before ? beside(row - side.row, col - side.col) : here;
  return (after - before) * (has_after && has_before ? 0.5 : 1.0);
}

/// The flow from a cell to its neighbour by `faces`, before the giver's limit; negative the other way.
double face_flow(const Bed& bed, int row, int col, Offset to, double& residual) {
  const TalusLaw& law = bed.law();
  const double down = bed.drop(row, col, to);
  if (!std::isfinite(down) || down == 0.0) return 0.0;
  const Offset next{row + to.row, col + to.col}, back{-to.row, -to.col}, side{to.col, to.row};
  const bool gives = down > 0.0;
  if (!(gives ? bed.has_sand(row, col) : bed.has_sand(next.row, next.col))) return 0.0;
  const double fall = std::abs(down);
  const double behind = gives ? bed.drop(row, col, back) : bed.drop(next.row, next.col, to);
  double along = fall;
  if (behind > 0.0) {
    const double low = std::min(fall, behind), high = std::max(fall, behind);
    along += low * low / (3.0 * high);
  }
  const double across =
      0.5 * (slope_across(bed, row, col, side) + slope_across(bed, next.row, next.col, side));
  along *= bed.weight(row, col, to);
  const double slope = std::sqrt(along * along + across * across);
  residual = std::max(residual, slope / law.axis_drop - 1.0);
  return slope > law.axis_limit ? law.share * (1.0 - law.axis_drop / slope) * down : 0.0;
}

/// paper and isotropic: each cell gives a part of its drops to its lower neighbours.
TalusPass pass_by_cells(const Bed& bed, CompensatedSum& moved) {
  const bool paper = bed.law().law == RelaxationLaw::paper;
  TalusPass pass{HeightGrid(bed.rows(), bed.cols()), false, 0.0};
  HeightGrid factors = HeightGrid::Zero(bed.rows(), bed.cols());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col)
      if (bed.has_sand(row, col))
        factors(row, col) = paper ? paper_factor(bed, row, col, pass.residual)
                                  : isotropic_factor(bed, row, col, pass.residual);
  pass.flows = !(factors == 0.0).all();
  if (!pass.flows) return pass;

  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      double out = 0.0, in = 0.0;
      const auto exchange = [&](const std::array<Offset, 4>& neighbours, double distance) {
        std::array<double, 4> given{}, taken{};
        for (int i = 0; i < 4; ++i) {
          const double down = bed.drop(row, col, neighbours[i]);
          if (!std::isfinite(down)) continue;
          const double threshold = paper ? bed.axis_drop(row, col, neighbours[i]) * distance : 0.0;
          const int r = row + neighbours[i].row, c = col + neighbours[i].col;
          const double up = bed.height(r, c) - bed.height(row, col);
          if (down > threshold) given[i] = factors(row, col) * down;
          if (up > threshold) taken[i] = factors(r, c) * up;
        }
        out += paired_sum(given);
        in += paired_sum(taken);
      };
      exchange(axis_neighbours, 1.0);
      if (paper) exchange(diagonal_neighbours, std::numbers::sqrt2);
      moved.add(out);
      pass.heights(row, col) = bed.gained(row, col, in - out);
    }
  return pass;
}

/// The flows through the faces around a cell, counted outwards.
std::array<double, 4> flows_out(const HeightGrid& right, const HeightGrid& below, int row, int col) {
  return {col > 0 ? -right(row, col - 1) : 0.0, right(row, col), row > 0 ? -below(row - 1, col) : 0.0,
          below(row, col)};
}

/// Scales what each cell gives, so that it gives at most what it has.
void limit_flows(const Bed& bed, HeightGrid& right, HeightGrid& below) {
  HeightGrid scale(bed.rows(), bed.cols());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      std::array<double, 4> out = flows_out(right, below, row, col);
      for (double& one : out) one = std::max(0.0, one);
      const double most = bed.law().most_given * bed.sand(row, col), sum = paired_sum(out);
      scale(row, col) = sum > most ? most / sum : 1.0;
    }
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      double &east = right(row, col), &south = below(row, col);
      if (east != 0.0) east *= east > 0.0 ? scale(row, col) : scale(row, col + 1);
      if (south != 0.0) south *= south > 0.0 ? scale(row, col) : scale(row + 1, col);
    }
}

/// faces: sand flows through the faces between cells.
TalusPass pass_by_faces(const Bed& bed, CompensatedSum& moved) {
  TalusPass pass{HeightGrid(bed.rows(), bed.cols()), false, 0.0};
  HeightGrid right(bed.rows(), bed.cols()), below(bed.rows(), bed.cols());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      right(row, col) = face_flow(bed, row, col, {0, 1}, pass.residual);
      below(row, col) = face_flow(bed, row, col, {1, 0}, pass.residual);
    }
  pass.flows = !((right == 0.0).all() && (below == 0.0).all());
  if (!pass.flows) return pass;

  limit_flows(bed, right, below);
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      const std::array<double, 4> out = flows_out(right, below, row, col);
      moved.add((std::max(0.0, out[1]) + std::max(0.0, out[0])) +
                (std::max(0.0, out[3]) + std::max(0.0, out[2])));
      pass.heights(row, col) = bed.gained(row, col, (-out[0] - out[1]) + (-out[2] - out[3]));
    }
  return pass;
}

}  // namespace

TalusPass talus_pass(const HeightGrid& heights, const WallGrid& walls, const TalusGround* ground,
                     const TalusLaw& law, CompensatedSum& moved) {
  const Bed bed(heights, walls, ground, law);
  return law.law == RelaxationLaw::faces ? pass_by_faces(bed, moved) : pass_by_cells(bed, moved);
}

}  // namespace sandstroke
