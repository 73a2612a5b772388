#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "rules/slip_surface.h"
#include "rules/talus.h"

namespace sandstroke {

// Which cuts in moist sand stand, and what comes down of those that do not. The sand that was never moved, or
// that has bonded again, is intact up to a level b; what lies above b is loose, and flows over it as over a
// floor (rules/talus.h). Of each toe, a cell beside an intact face, one ray goes uphill. A chord from the toe
// to the intact surface, at run r and rise D, cuts off a wedge of area A between it and the surface (per
// width, loose sand included). With the slope T = D / r of the chord, mu = tan(phi), and c / gamma the
// cohesion over the weight per volume, the wedge fails where
//   A (T - mu) / (1 + T^2)  >  kappa(T) c / gamma r,
// which is limit equilibrium. What fails lowers b to the chord on the ray and in a fan beside it.
//
// Not modelled: buckling of slender columns, cracks under tension, arching in round pits, water that moves.

/// The way uphill from a toe: a unit vector, in rows and columns; or zero.
struct Uphill {
  double row, col;
};

/// The worst wedge of a toe. Lengths in m.
struct Wedge {
  double need = 0.0;  ///< the cohesion that it needs, over what there is; fails above 1
  double run = 0.0, rise = 0.0;
  double offset = 0.0;  ///< of the face's foot from the toe cell's centre, from where the run counts
  int cells = 0;        ///< the ray's, to the chord's end
};

namespace standing {

/// Cells within which a face's direction is looked for, and the tangent of the half angle to either side of
/// a ray within which a wedge comes down. The latter leaves no fins between the rays of a round pit.
inline constexpr int reach = 3;
inline constexpr double fan = 0.2;
/// Where sand failed, intact sand that is narrower than a disc of this radius [cells] fails, too.
inline constexpr int opening = 2;
/// The offsets within a disc of this radius.
inline bool in_disc(int rows, int cols, int radius) {
  return rows * rows + cols * cols <= radius * radius + 1;
}

}  // namespace standing

// `Sand` tells a bed's cells: rows(), cols(), cell_size() [m]; has_sand(row, col), false outside the bed;
// height, intact and floor(row, col) [m], floor <= intact <= height, floor -infinity where there is none;
// highest_floor() of all cells; cohesion(row, col) over the weight per volume [m], the same everywhere if
// is_uniform(); is_rectangle(): the bed is. All sums go over opposite pairs, so that mirrored and
// turned beds have mirrored and turned bits.

/// Whether a cell lies beside intact sand that is steeper than mu.
template <class Sand>
bool is_toe(const Sand& sand, int row, int col, double mu) {
  const double here = sand.height(row, col), axis = mu * sand.cell_size(), diagonal = axis * std::sqrt(2.0);
  for (int r = -1; r <= 1; ++r)
    for (int c = -1; c <= 1; ++c)
      if ((r != 0 || c != 0) && sand.has_sand(row + r, col + c) &&
          sand.intact(row + r, col + c) - here > (r != 0 && c != 0 ? diagonal : axis))
        return true;
  return false;
}

/// The normal of the face above a toe: the sum over the cells within reach of by how much each is above mu,
/// times the unit vector to it. Zero where there is none.
template <class Sand>
Uphill uphill_of(const Sand& sand, int row, int col, double mu) {
  const double here = sand.height(row, col), axis = mu * sand.cell_size();
  const auto above = [&](int r, int c, double far) {
    if (!sand.has_sand(row + r, col + c)) return 0.0;
    return std::max(0.0, sand.intact(row + r, col + c) - here - far * axis);
  };
  Uphill sum{0.0, 0.0};
  for (int along = 1; along <= standing::reach; ++along)
    for (int across = 0; across <= standing::reach; ++across) {
      if (along * along + across * across > standing::reach * standing::reach) continue;
      const double far = std::sqrt(static_cast<double>(along * along + across * across)), part = along / far;
      const auto pair_in_cols = [&](int r) { return above(r, along, far) - above(r, -along, far); };
      const auto pair_in_rows = [&](int c) { return above(along, c, far) - above(-along, c, far); };
      const bool both = across > 0;
      sum.col += part * (both ? pair_in_cols(across) + pair_in_cols(-across) : pair_in_cols(0));
      sum.row += part * (both ? pair_in_rows(across) + pair_in_rows(-across) : pair_in_rows(0));
    }
  const double length = std::sqrt(sum.row * sum.row + sum.col * sum.col);
  if (!(length > 0.0)) return {0.0, 0.0};
  return {sum.row / length, sum.col / length};
}

/// The sand at a point of a ray.
struct RaySample {
  double height, intact, cohesion;
  double floor = 0.0;  ///< above the toe; 0: no floor matters
};

/// Goes along a ray from a toe, one cell a step.
template <class Sand>
class Ray {
 public:
  Ray(const Sand& sand, int row, int col, const Uphill& uphill)
      : sand_(sand),
        row_(row),
        col_(col),
        toe_(sand.height(row, col)),
        rows_(uphill.row),
        cols_(uphill.col) {}

  /// Bilinear between cells' centres. False: a cell there has no sand.
  bool sample(int cells, RaySample& out) const {
    const Way down(rows_, cells), across(cols_, cells);
    const int r0 = row_ + down.near, r1 = row_ + down.far, c0 = col_ + across.near, c1 = col_ + across.far;
    if (!sand_.has_sand(r0, c0) || !sand_.has_sand(r1, c1)) return false;
    if (!sand_.is_rectangle() && (!sand_.has_sand(r0, c1) || !sand_.has_sand(r1, c0))) return false;
    const double p = down.part, q = across.part, near_near = (1.0 - p) * (1.0 - q), far_far = p * q,
                 far_near = p * (1.0 - q), near_far = (1.0 - p) * q;
    const auto mean = [&](const auto& of) {
      return (near_near * of(r0, c0) + far_far * of(r1, c1)) +
             (far_near * of(r1, c0) + near_far * of(r0, c1));
    };
    out.height = mean([&](int r, int c) { return sand_.height(r, c); });
    out.intact = mean([&](int r, int c) { return sand_.intact(r, c); });
    if (sand_.highest_floor() > toe_)
      out.floor = mean([&](int r, int c) { return std::max(0.0, sand_.floor(r, c) - toe_); });
    out.cohesion = sand_.is_uniform() ? sand_.cohesion(r0, c0)
                                      : mean([&](int r, int c) { return sand_.cohesion(r, c); });
    return true;
  }

 private:
  /// The cells on one axis between which a point lies, counted from the toe, and where between.
  struct Way {
    Way(double direction, int cells) {
      const double far_off = std::abs(direction) * cells;
      const int whole = static_cast<int>(far_off), sign = direction < 0.0 ? -1 : 1;
      part = far_off - whole;
      near = sign * whole;
      far = part > 0.0 ? near + sign : near;
    }
    int near, far;
    double part;
  };
  const Sand& sand_;
  int row_, col_;
  double toe_, rows_, cols_;
};

/// The chords along one ray, as it goes on.
class Chords {
 public:
  /// cell_size, toe [m]: the toe's height. least_need: wedges that need less do not matter.
  Chords(const CohesionFactor& factor, double cell_size, double toe, double least_need)
      : factor_(factor), mu_(factor.friction()), cell_size_(cell_size), toe_(toe) {
    before_.height = before_.intact = toe;
    worst_.need = least_need;
  }
  void begin_at(double offset) { worst_.offset = offset; }

  void add(int cells, const RaySample& here) {
    const double run = cells * cell_size_ - worst_.offset, area_before = area_;
    area_ += 0.5 * (here.height + before_.height - 2.0 * toe_) * cell_size_;
    if (here.cohesion != cohesion_) cohesion_ += (here.cohesion - cohesion_) / cells;
    if (here.floor > 0.0) {
      const double slope = (here.floor - before_.floor) / cell_size_;
      over_floor_.push_back({run, here.height - toe_, here.floor, (slope - mu_) / (1.0 + slope * slope)});
    }
    judge(cells, run, area_, here.intact - toe_);
    if (here.intact < before_.intact && cells > 1) {  // a face that looks away: the chord may end in it
      const double face = run - 0.5 * cell_size_,
                   area = area_before + 0.5 * (before_.height - toe_) * cell_size_;
      const double rise = (area + 0.5 * mu_ * face * face) / (face + 2.0 * cohesion_);
      judge(cells, face, area, std::clamp(rise, here.intact - toe_, before_.intact - toe_));
    }
    before_ = here;
  }
  const Wedge& worst() const { return worst_; }

 private:
  void judge(int cells, double run, double area, double rise) {
    const double lead = rise - mu_ * run, square = run * run + rise * rise;
    if (!(run > 0.0 && lead > 0.0)) return;
    // Both sides of the rule times run (1 + T^2).
    double load = (area - 0.5 * run * rise) * lead, hold = cohesion_ * square;
    if (over_floor_.empty() && !(load > worst_.need * (hold * factor_.least()))) return;
    // A spiral sags below its chord. Where the floor rises under the wedge it has no room, and planes count.
    if (over_floor_.empty() || over_floor_.front().along > run)
      hold *= factor_(rise, run);
    else
      load += slides_on_floor(run, rise) * square / run;
    if (!(load > worst_.need * hold)) return;
    worst_.need = load / hold;
    worst_.run = run;
    worst_.rise = rise;
    worst_.cells = cells;
  }
  /// What drives the wedge more where it slides on the floor than it would on the chord below.
  double slides_on_floor(double run, double rise) const {
    const double slope = rise / run, drives = (slope - mu_) / (1.0 + slope * slope);
    double more = 0.0;
    for (const OverFloor& one : over_floor_) {
      const double chord = one.along * slope;
      if (one.along > run || one.floor <= chord) continue;
      const double width = std::min(cell_size_, run - one.along + 0.5 * cell_size_);
      more += width * (one.drives * (one.height - one.floor) - drives * (one.height - chord));
    }
    return more;
  }

  /// A sample whose floor is above the toe: a wedge whose chord is below the floor slides on that.
  struct OverFloor {
    double along, height, floor;  // m, the latter above the toe
    double drives;                // of the floor's slope, as of a chord's
  };
  const CohesionFactor& factor_;
  double mu_, cell_size_, toe_;
  RaySample before_{};
  double area_ = 0.0, cohesion_ = 0.0;  // m^2; m, the mean so far
  std::vector<OverFloor> over_floor_;
  Wedge worst_;
};

/// The worst wedge of a toe, of those that are no longer than this [m] and need more than least_need.
template <class Sand>
Wedge worst_wedge(const Sand& sand, int row, int col, const Uphill& uphill, const CohesionFactor& factor,
                  double longest, double least_need = 0.0) {
  const double toe = sand.height(row, col), cell_size = sand.cell_size(), mu = factor.friction();
  const Ray<Sand> ray(sand, row, col, uphill);
  Chords chords(factor, cell_size, toe, least_need);
  RaySample here{}, next{};
  if (!ray.sample(1, here) || !(here.intact - toe > mu * cell_size)) return {};
  // A cliff with a flat top has its face half a cell from the toe's centre; a slope that goes on begins
  // there.
  double offset = 0.0;
  if (ray.sample(2, next))
    offset = 0.5 * cell_size * std::clamp(1.0 - (next.intact - here.intact) / (here.intact - toe), 0.0, 1.0);
  chords.begin_at(offset);
  for (int cells = 1; cells * cell_size - offset <= longest; ++cells) {
    if (!ray.sample(cells, here)) break;
    chords.add(cells, here);
  }
  return chords.worst();
}

/// Calls visit(row, col, level) for the cells of a bed of this size that come down with a wedge, where level
/// [m] is the chord's there.
template <class Visit>
void visit_wedge(int row, int col, double toe, const Uphill& uphill, const Wedge& wedge, double cell_size,
                 int rows, int cols, const Visit& visit) {
  const double slope = wedge.rise / wedge.run, half = standing::fan * wedge.cells;
  const auto span = [&](int from, double along, double across, int end) {
    const double far = wedge.cells * along, side = half * std::abs(across) + 1.0;
    return std::pair(std::max(0, from + static_cast<int>(std::floor(std::min(0.0, far) - side))),
                     std::min(end, from + static_cast<int>(std::ceil(std::max(0.0, far) + side)) + 1));
  };
  const auto [row_begin, row_end] = span(row, uphill.row, uphill.col, rows);
  const auto [col_begin, col_end] = span(col, uphill.col, uphill.row, cols);
  for (int r = row_begin; r < row_end; ++r)
    for (int c = col_begin; c < col_end; ++c) {
      const double along = (c - col) * uphill.col + (r - row) * uphill.row,
                   beside = std::abs((r - row) * uphill.col - (c - col) * uphill.row);
      const double run = along * cell_size - wedge.offset;
      if (!(along > 0.0) || run < 0.0 || run > wedge.run) continue;
      if (beside > std::max(1.0 - 1e-9, along * standing::fan)) continue;
      visit(r, c, toe + run * slope);
    }
}

/// Opens a level [m] near the cells where it is lower than before: there no part of it stays up that is
/// narrower than the disc.
void open_level(const HeightGrid& before, HeightGrid& level);

/// A look at all cells of a bed.
struct CutsLook {
  HeightGrid intact;  ///< m, afterwards
  int toes = 0;       ///< cells beside a face that could fail
  int failed = 0;     ///< those whose wedge fails
  double need = 0.0;  ///< the greatest of their wedges' needs
};

/// Looks at every toe that is not a wall, all from the same sand, and lowers the intact level [m] where
/// wedges fail. floor [m]: -infinity where there is none. cohesion: over the weight per volume [m].
CutsLook look_at_cuts(const HeightGrid& heights, const HeightGrid& intact, const HeightGrid& floor,
                      const HeightGrid& cohesion, const WallGrid& walls, const CohesionFactor& factor,
                      double cell_size);

}  // namespace sandstroke
