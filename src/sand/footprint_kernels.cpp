// The fast form of the filter and of PlainDisplacement (rules/displacement.h), many cells at once.
// tests/sand/engine_equality_test.cpp and tests/run/golden_displacement_test.cpp check that both give the
// same bits.
#include "sand/footprint_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/footprint_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rules/filter.h"
#include "sand/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

/// sin(u) for 0 <= u <= 1.2: the series up to u^17, whose remainder is below 3e-16.
HWY_INLINE V sine(V u) {
  constexpr double terms[] = {1.0 / 355687428096000, -1.0 / 1307674368000, 1.0 / 6227020800, -1.0 / 39916800,
                              1.0 / 362880,          -1.0 / 5040,          1.0 / 120,        -1.0 / 6};
  const V u2 = u * u;
  V sum = all(terms[0]);
  for (int i = 1; i < 8; ++i) sum = sum * u2 + all(terms[i]);
  return u + u * (u2 * sum);
}

/// x, limited to 0 ... 1.
HWY_INLINE V clamped(V x) { return Min(Max(x, hn::Zero(d)), all(1.0)); }

/// Flags the cells with sand, in a vector whose first column in the window is `col`.
HWY_INLINE Mask has_sand(const ColumnRange& sand, int col) {
  const V at = hn::Iota(d, col);
  return hn::And(at >= all(sand.begin), at < all(sand.end));
}

/// Where the cells of a window lie relative to the tool's axis [m]; infinitely far where they have no sand.
class Offsets {
 public:
  explicit Offsets(const ToolFootprint& f)
      : dx_(f.cell_size()),
        first_x_(f.first_x()),
        first_y_(f.first_y()),
        axis_x_(f.axis_x()),
        axis_y_(f.axis_y()) {}
  HWY_INLINE V x(const ColumnRange& sand, int col) const {
    const V x = (hn::Iota(d, first_x_ + col) - all(axis_x_)) * all(dx_);
    return hn::IfThenElse(has_sand(sand, col), x, all(std::numeric_limits<double>::infinity()));
  }
  double y(int row) const { return (first_y_ + row - axis_y_) * dx_; }

 private:
  double dx_;
  double first_x_, first_y_, axis_x_, axis_y_;
};

/// Factors for bounds just above and below a squared distance, wider than its rounding.
constexpr double above = 1.0 + 1e-14, below = 1.0 - 1e-14;

/// The mean of height_of(what row_of(row) has) over the cells that a level counts.
template <class RowOf, class HeightOf>
HWY_INLINE double mean_under(const SphereShape& shape, const ToolFootprint& f, const RowOf& row_of,
                             const HeightOf& height_of) {
  const double reach2 = shape.reach * shape.reach, beyond = shape.reach + f.cell_size();
  const V one = all(1.0), rho1 = all(shape.reach), cell = all(f.cell_size());
  const V near2 = all(reach2 * below), far2 = all(beyond * beyond * above);
  const Offsets offsets(f);
  LaneSum heights, weights;
  for (int row = 0; row < f.cells().rows(); ++row) {
    const V y = all(offsets.y(row)), y2 = y * y;
    const ColumnRange sand = f.sand_cols(row);
    const double* cells = row_of(row);
    for (int col = 0, end = f.stride(); col < end; col += lanes) {
      const V x = offsets.x(sand, col), rho2 = x * x + y2;
      if (hn::AllFalse(d, rho2 <= far2)) continue;
      const V height = height_of(hn::Load(d, cells + col));
      if (hn::AllTrue(d, rho2 <= near2)) {
        heights.add(col, height);
        weights.add(col, one);
      } else {
        const V weight = clamped((rho1 - Sqrt(rho2)) / cell + one);
        heights.add(col, weight * height);
        weights.add(col, weight);
      }
    }
  }
  const double weight = weights.total();
  return weight > 0.0 ? heights.total() / weight : std::numeric_limits<double>::quiet_NaN();
}

double LevelOf(const SphereShape& shape, const ToolFootprint& f) {
  return mean_under(
      shape, f, [&](int row) { return f.heights(row); }, [](V height) { return height; });
}
double FloorAbove(const SphereShape& shape, const ToolFootprint& f, double tip_height) {
  const V zero = hn::Zero(d), tip = all(tip_height);
  return mean_under(
      shape, f, [&](int row) { return f.floors(row); }, [&](V floor) { return Max(floor - tip, zero); });
}

HWY_INLINE void set_flags(unsigned char* flags, int col, Mask mask) {
  flags[col / group] = static_cast<unsigned char>(flags[col / group] | bits(mask) << (col % group));
}

/// What is left of sand that was cut: the floor itself where that is above the underside, and nowhere less.
/// A rounded difference may end just below it.
HWY_INLINE V down_to(V left, V floor, V underside) {
  return hn::IfThenElse(floor >= underside, floor, Max(left, floor));
}

/// over_floor: the floor may be above the tool's underside.
template <bool ring, bool over_floor>
HWY_INLINE Carved carve(const SphereShape& shape, ToolFootprint& f, double tip_height,
                        const RingFront& front) {
  const V zero = hn::Zero(d), one = all(1.0), half = all(0.5);
  const V infinite = all(std::numeric_limits<double>::infinity()), tip = all(tip_height);
  const double square = shape.radius * shape.radius;
  const V R = all(shape.radius), R2 = all(square), under = all(square * below);
  const V beyond = all((ring ? shape.reach * shape.reach : square) * above);
  const V s2 = all(shape.filter_scale2), a = all(shape.amplitude), offset = all(filter::offset);
  const V u0 = all(filter::u0), u1 = all(filter::u1);
  const V cell = all(f.cell_size()), drag = all(front.drag_fraction), rim = all(tip_height + shape.radius);
  const bool sphere = shape.profile == ToolProfile::sphere;
  const Offsets offsets(f);
  LaneSum sum, front_weight, ring_weight;
  for (int row = 0; row < f.cells().rows(); ++row) {
    const V y = all(offsets.y(row)), y2 = y * y, ahead_y = all(offsets.y(row) * front.direction.y());
    const ColumnRange sand = f.sand_cols(row);
    double *heights = f.heights(row), *undersides = f.underside(row), *ring_weights = f.ring_weight(row),
           *weights = f.weights(row);
    unsigned char* flags = f.flags(row);
    std::fill_n(flags, f.stride() / group, static_cast<unsigned char>(0));
    for (int col = 0, end = f.stride(); col < end; col += lanes) {
      const V x = offsets.x(sand, col), rho2 = x * x + y2;
      V underside = infinite, takes = where(rho2 < infinite, one), on_ring = zero;
      if (sphere && hn::AllTrue(d, rho2 <= under)) {
        underside = R - Sqrt(R2 - rho2);
        takes = zero;
      } else if (!hn::AllFalse(d, rho2 <= beyond)) {
        const V u = rho2 / s2, sin_u = ring || !sphere ? sine(u) : zero;
        const Mask bowl = u <= u0;
        // The root's argument may fall below 0 by rounding at the rim.
        underside = hn::IfThenElse(bowl, sphere ? R - Sqrt(Max(R2 - rho2, zero)) : a * sin_u, infinite);
        takes = hn::IfThenZeroElse(bowl, takes);
        if (ring) on_ring = where(hn::And(u > u0, u <= u1), Max(sin_u - offset, zero));
      }
      hn::Store(underside, d, undersides + col);
      const V height = hn::Load(d, heights + col);
      V lowest = tip + underside, floor = zero;
      if (over_floor) {
        floor = hn::Load(d, f.floors(row) + col);
        lowest = Max(lowest, floor);
        const Mask is_high = floor > rim;
        takes = hn::IfThenZeroElse(is_high, takes);
        on_ring = hn::IfThenZeroElse(is_high, on_ring);
      }
      const V excess = Max(height - lowest, zero);
      const Mask cut = excess > zero;
      if (!hn::AllFalse(d, cut)) {
        V left = height - excess;
        if (over_floor) left = hn::IfThenElse(cut, down_to(left, floor, tip + underside), height);
        hn::Store(left, d, heights + col);
        hn::Store(excess, d, f.excess(row) + col);
        sum.add(col, excess);
        set_flags(flags, col, cut);
      }
      if (!ring) {
        hn::Store(takes, d, f.takes(row) + col);
        continue;
      }
      V weight = on_ring;
      const Mask in_ring = on_ring > zero;  // elsewhere offsets may be infinite
      if (front.drag_fraction > 0.0 && !hn::AllFalse(d, in_ring)) {
        const V p = x * all(front.direction.x()) + ahead_y;
        weight = where(in_ring, on_ring * (one - drag * (one - clamped(p / cell + half))));
      }
      hn::Store(on_ring, d, ring_weights + col);
      hn::Store(weight, d, weights + col);
      front_weight.add(col, weight);
      ring_weight.add(col, on_ring);
    }
  }
  return {sum.total(), front_weight.total(), ring_weight.total()};
}

/// Whether a tool whose lowest point is here [m] may reach the floor. The cell of slack is for rounding: both
/// variants give the same bits there.
bool reaches_floor(const ToolFootprint& f, double lowest) {
  return std::isfinite(lowest) && f.highest_floor() > lowest - f.cell_size();
}

Carved CarveForRing(const SphereShape& shape, ToolFootprint& f, double tip_height, const RingFront& front) {
  return reaches_floor(f, tip_height) ? carve<true, true>(shape, f, tip_height, front)
                                      : carve<true, false>(shape, f, tip_height, front);
}
double CarveOnly(const SphereShape& shape, ToolFootprint& f, double tip_height) {
  const RingFront none{0.0, Eigen::Vector2d::Zero()};
  return reaches_floor(f, tip_height) ? carve<false, true>(shape, f, tip_height, none).sum
                                      : carve<false, false>(shape, f, tip_height, none).sum;
}

template <bool over_floor>
HWY_INLINE CarvedUnder carve_under(const EnvelopeWindow& envelope, ToolFootprint& f, double tip_height) {
  const V zero = hn::Zero(d), half = all(0.5), tip = all(tip_height);
  const V infinite = all(std::numeric_limits<double>::infinity());
  // The cut heights are multiples of 2^-40 cells or less. So their sum is exact in any order, and a second
  // carve finds nothing to cut.
  const V shift = all(std::scalbn(1.5 * 0x1p12, std::ilogb(f.cell_size()))),
          nearly = all(-0x1p-38 * f.cell_size());
  LaneSum sum, rests;
  V highest = all(-std::numeric_limits<double>::infinity());
  for (int row = 0; row < f.cells().rows(); ++row) {
    const ColumnRange sand = f.sand_cols(row);
    double* heights = f.heights(row);
    unsigned char* flags = f.flags(row);
    std::fill_n(flags, f.stride() / group, static_cast<unsigned char>(0));
    // Adds diagonal corners first, so that a quarter turn gives the same bits.
    const auto between = [&](const double* const* corners, int col) {
      const auto part = [&](int i) {
        return all(envelope.weight[i]) * hn::LoadU(d, corners[i] + row * envelope.stride + col);
      };
      return (part(0) + part(3)) + (part(1) + part(2));
    };
    for (int col = 0, end = f.stride(); col < end; col += lanes) {
      const Mask covered = hn::And(has_sand(sand, col), between(envelope.cover, col) >= half);
      const V underside = hn::IfThenElse(covered, between(envelope.underside, col), infinite);
      hn::Store(underside, d, f.underside(row) + col);
      const V height = hn::Load(d, heights + col);
      V lowest = tip + underside, floor = zero;
      if (over_floor) {
        floor = hn::Load(d, f.floors(row) + col);
        lowest = Max(lowest, floor);
      }
      const V overlap = height - lowest, whole = Max(overlap, zero) + shift - shift;
      V excess = whole;
      if (over_floor) {  // down to the floor exactly: what that takes beyond a multiple is added up by itself
        const Mask bares = hn::And(floor >= tip + underside, overlap > zero);
        rests.add(col, where(bares, overlap - whole));
        excess = hn::IfThenElse(bares, overlap, whole);
      }
      const Mask touches = overlap >= nearly, cut = excess > zero;
      if (hn::AllFalse(d, touches)) continue;
      highest = Max(highest, hn::IfThenElse(touches, underside, highest));
      if (hn::AllFalse(d, cut)) continue;
      V left = height - excess;
      if (over_floor) left = hn::IfThenElse(cut, down_to(left, floor, tip + underside), height);
      hn::Store(left, d, heights + col);
      hn::Store(excess, d, f.excess(row) + col);
      sum.add(col, whole);
      set_flags(flags, col, cut);
    }
  }
  return {over_floor ? sum.total() + rests.total() : sum.total(), largest(highest)};
}

CarvedUnder CarveUnder(const EnvelopeWindow& envelope, ToolFootprint& f, double tip_height) {
  return reaches_floor(f, tip_height + envelope.lowest) ? carve_under<true>(envelope, f, tip_height)
                                                        : carve_under<false>(envelope, f, tip_height);
}

void CoverUpTo(ToolFootprint& f, double height) {
  const V infinite = all(std::numeric_limits<double>::infinity());
  for (int row = 0; row < f.cells().rows(); ++row) {
    const ColumnRange sand = f.sand_cols(row);
    for (int col = 0, end = f.stride(); col < end; col += lanes) {
      const V underside = hn::Load(d, f.underside(row) + col);
      const Mask covered = underside <= all(height);
      hn::Store(hn::IfThenElse(covered, underside, infinite), d, f.underside(row) + col);
      hn::Store(where(hn::AndNot(covered, has_sand(sand, col)), all(1.0)), d, f.takes(row) + col);
    }
  }
}

/// A group of cut cells: their positions [cells from the axis], their sand [m], its targets [cells from the
/// axis; NaN: nowhere], and the cells that take it.
struct CutCells {
  alignas(64) double x[group], y[group], excess[group];
  alignas(64) double to_x[group], to_y[group];
  alignas(64) double part[4][group];
  alignas(64) std::int64_t to[4][group];
};

/// Aims sand away from the axis of a sphere; sand right on the axis goes nowhere. aside: the sand starts this
/// far beside the cells' centres, around the axis [cells].
HWY_INLINE void aim_from_axis(const ToolFootprint& f, const Outward& outward, double aside, CutCells& cells,
                              int i) {
  const V x = hn::Load(d, cells.x + i), y = hn::Load(d, cells.y + i);
  const V turn = all(aside) / Sqrt(x * x + y * y);
  const V from_x = x - turn * y, from_y = y + turn * x;
  const V ratio = all(outward.distance / f.cell_size()) / Sqrt(from_x * from_x + from_y * from_y);
  hn::Store(ratio * from_x, d, cells.to_x + i);
  hn::Store(ratio * from_y, d, cells.to_y + i);
}

HWY_INLINE V spread_cells(const ToolFootprint& f, double rounding_shift, CutCells& cells, int i) {
  const hn::RebindToSigned<decltype(d)> di;
  const V zero = hn::Zero(d), one = all(1.0), shift = all(rounding_shift);
  const V axis_x = all(f.axis_x() - f.first_x()), axis_y = all(f.axis_y() - f.first_y());  // columns, rows
  const V to_x = hn::Load(d, cells.to_x + i), to_y = hn::Load(d, cells.to_y + i);
  // Rounded towards 0. Below 0 that rounds up, but no cell of the window lies there.
  const V first_col = hn::Trunc(axis_x + to_x), first_row = hn::Trunc(axis_y + to_y);
  const V rows = all(f.cells().rows()), cols = all(f.cells().cols()), stride = all(f.stride());
  const auto corner_weight = [&](int down, int right, V& to) {
    const V row = first_row + all(down), col = first_col + all(right);
    const Mask inside = hn::And(hn::And(row >= zero, row < rows), hn::And(col >= zero, col < cols));
    to = where(inside, row * stride + col);
    const V takes = hn::GatherIndex(d, f.takes(0), hn::ConvertTo(di, to));
    const V near_x = Max(zero, one - hn::Abs(col - axis_x - to_x)),
            near_y = Max(zero, one - hn::Abs(row - axis_y - to_y));
    return where(inside, near_x * near_y * takes);
  };
  V to[4];
  const V corner_weights[4] = {corner_weight(0, 0, to[0]), corner_weight(0, 1, to[1]),
                               corner_weight(1, 0, to[2]), corner_weight(1, 1, to[3])};
  const V whole =
      (corner_weights[0] + corner_weights[3]) + (corner_weights[1] + corner_weights[2]);  // symmetric
  const Mask goes = whole > zero;
  const V excess = hn::Load(d, cells.excess + i);
  V total = zero;
  for (int corner = 0; corner < 4; ++corner) {
    const V part = where(goes, excess * (corner_weights[corner] / whole) + shift - shift);
    total += part;
    hn::Store(part, d, cells.part[corner] + i);
    hn::Store(hn::ConvertTo(di, where(goes, to[corner])), di, cells.to[corner] + i);
  }
  return total;
}

double SpreadOutward(ToolFootprint& f, double carved, const Outward& outward) {
  // x + shift - shift rounds x to multiples of a quantum. The quantum is such that sums of parts of `carved`
  // are exact, and so the same in any order: a symmetric tool leaves symmetric sand.
  const double shift = std::scalbn(3.0, std::ilogb(carved) + 1);
  for (int row = 0; row < f.cells().rows(); ++row) std::fill_n(f.weights(row), f.stride(), 0.0);
  CutCells cells;
  int count = 0;
  V total = hn::Zero(d);  // sums of these parts are exact, in any order
  const auto put = [&] {
    for (int i = 0; i < group; i += lanes) total += spread_cells(f, shift, cells, i);
    for (int i = 0; i < group; ++i)
      for (int corner = 0; corner < 4; ++corner) f.weights(0)[cells.to[corner][i]] += cells.part[corner][i];
  };
  const auto spread = [&] {
    count = 0;
    if (outward.way) return put();
    // Each cell's sand goes in three parts, each in its own direction, because a cell is wide compared with
    // its distance from the axis. (16 parts are no better.)
    for (double& excess : cells.excess) excess /= 3.0;
    for (const double aside : {-1.0 / 3.0, 0.0, 1.0 / 3.0}) {
      for (int i = 0; i < group; i += lanes) aim_from_axis(f, outward, aside, cells, i);
      put();
    }
  };
  const double axis_x = f.axis_x() - f.first_x(), axis_y = f.axis_y() - f.first_y();
  for (int row = 0; row < f.cells().rows(); ++row)
    for (int g = 0; g < f.stride() / group; ++g)
      for (unsigned flags = f.flags(row)[g]; flags != 0; flags &= flags - 1) {
        const int col = g * group + std::countr_zero(flags);
        cells.x[count] = col - axis_x;
        cells.y[count] = row - axis_y;
        cells.excess[count] = f.excess(row)[col];
        if (outward.way)
          outward.way->aim(row, col, cells.x[count], cells.y[count], cells.to_x[count], cells.to_y[count]);
        if (++count == group) spread();
      }
  for (int rest = count; rest < group; ++rest)
    cells.x[rest] = cells.y[rest] = cells.excess[rest] = cells.to_x[rest] = cells.to_y[rest] = 0.0;
  if (count > 0) spread();
  alignas(64) double sums[group] = {};
  hn::Store(total, d, sums);
  double sum = 0.0;
  for (const double one : sums) sum += one;
  return sum;
}

void DepositWeights(ToolFootprint& f, double rise, DepositBy by) {
  for (int row = 0; row < f.cells().rows(); ++row) {
    const double* weights = by == DepositBy::ring_weight ? f.ring_weight(row) : f.weights(row);
    for (int col = 0; col < f.stride(); col += lanes) {
      const V weight = hn::Load(d, weights + col);
      const Mask heaped = weight > hn::Zero(d);
      if (hn::AllFalse(d, heaped)) continue;
      double* height = f.heights(row) + col;
      hn::Store(hn::Load(d, height) + all(rise) * weight, d, height);
      set_flags(f.flags(row), col, heaped);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sandstroke {

HWY_EXPORT(LevelOf);
HWY_EXPORT(FloorAbove);
HWY_EXPORT(CarveOnly);
HWY_EXPORT(CarveForRing);
HWY_EXPORT(CarveUnder);
HWY_EXPORT(CoverUpTo);
HWY_EXPORT(SpreadOutward);
HWY_EXPORT(DepositWeights);

double level_of(const SphereShape& shape, const ToolFootprint& footprint) {
  return HWY_DYNAMIC_DISPATCH(LevelOf)(shape, footprint);
}
double floor_above(const SphereShape& shape, const ToolFootprint& footprint, double tip_height) {
  return HWY_DYNAMIC_DISPATCH(FloorAbove)(shape, footprint, tip_height);
}
double carve(const SphereShape& shape, ToolFootprint& footprint, double tip_height) {
  return HWY_DYNAMIC_DISPATCH(CarveOnly)(shape, footprint, tip_height);
}
Carved carve_for_ring(const SphereShape& shape, ToolFootprint& footprint, double tip_height,
                      const RingFront& front) {
  return HWY_DYNAMIC_DISPATCH(CarveForRing)(shape, footprint, tip_height, front);
}
CarvedUnder carve_under(const EnvelopeWindow& envelope, ToolFootprint& footprint, double tip_height) {
  return HWY_DYNAMIC_DISPATCH(CarveUnder)(envelope, footprint, tip_height);
}
void cover_up_to(ToolFootprint& footprint, double height) {
  HWY_DYNAMIC_DISPATCH(CoverUpTo)(footprint, height);
}
double spread_outward(ToolFootprint& footprint, double carved, const Outward& outward) {
  return HWY_DYNAMIC_DISPATCH(SpreadOutward)(footprint, carved, outward);
}
void deposit(ToolFootprint& footprint, double rise, DepositBy by) {
  HWY_DYNAMIC_DISPATCH(DepositWeights)(footprint, rise, by);
}

}  // namespace sandstroke
#endif
