#include "sand/tile_kernels.h"

#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/tile_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int side = BedGeometry::tile_side;
constexpr int group = 8;
constexpr int groups = side / group;

const hn::CappedTag<double, group> d;
using V = hn::Vec<decltype(d)>;
constexpr int lanes = static_cast<int>(hn::MaxLanes(d));

/// The lower one; a wall (NaN) as `a` loses.
HWY_INLINE V lower(V a, V b) {
#if HWY_ARCH_X86
  return hn::Min(a, b);  // min*pd: the second operand where one is NaN
#else
  return hn::IfThenElse(hn::Lt(a, b), a, b);
#endif
}

/// The higher one; a wall (NaN) as `a` loses.
HWY_INLINE V higher(V a, V b) {
#if HWY_ARCH_X86
  return hn::Max(a, b);
#else
  return hn::IfThenElse(hn::Gt(a, b), a, b);
#endif
}

HWY_INLINE V above(V x, V threshold) { return hn::IfThenElseZero(hn::Gt(x, threshold), x); }

/// Flags of up to 8 lanes, as the low bits.
HWY_INLINE unsigned bits(hn::Mask<decltype(d)> mask) {
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0];
}
HWY_INLINE hn::Mask<decltype(d)> lanes_of(unsigned flags) {
  const uint8_t bytes[8] = {static_cast<uint8_t>(flags)};
  return hn::LoadMaskBits(d, bytes);
}

/// A cell and its neighbours, `lanes` of them from column `c`.
struct Around {
  V m, w, e, n, s;
  HWY_INLINE Around(const double* row, int c)
      : m(hn::Load(d, row + c)),
        w(hn::LoadU(d, row + c - 1)),
        e(hn::LoadU(d, row + c + 1)),
        n(hn::Load(d, row + c - TilePatch::stride)),
        s(hn::Load(d, row + c + TilePatch::stride)) {}
};
struct Corners {
  V nw, ne, sw, se;
  HWY_INLINE Corners(const double* row, int c)
      : nw(hn::LoadU(d, row + c - TilePatch::stride - 1)),
        ne(hn::LoadU(d, row + c - TilePatch::stride + 1)),
        sw(hn::LoadU(d, row + c + TilePatch::stride - 1)),
        se(hn::LoadU(d, row + c + TilePatch::stride + 1)) {}
};

// The steepest drops of a cell, at least 0: subtraction is monotone, so the drop to the lowest neighbour is
// the largest of the drops.
HWY_INLINE V axis_drop(const Around& a) {
  return hn::Sub(a.m, lower(a.w, lower(a.e, lower(a.n, lower(a.s, a.m)))));
}
HWY_INLINE V diagonal_drop(V m, const Corners& k) {
  return hn::Sub(m, lower(k.nw, lower(k.se, lower(k.ne, lower(k.sw, m)))));
}
HWY_INLINE V squared_slope(const Around& a) {
  const V gx = hn::Sub(a.m, lower(a.w, lower(a.e, a.m))), gy = hn::Sub(a.m, lower(a.n, lower(a.s, a.m)));
  return hn::Add(hn::Mul(gx, gx), hn::Mul(gy, gy));
}

/// The largest drops met, lane by lane; isotropic: axis holds their squares' sum.
struct Drops {
  V axis, diagonal;
  HWY_INLINE Drops() : axis(hn::Zero(d)), diagonal(hn::Zero(d)) {}
};

/// Which of the cells in a vector may give: all, or those with a flag.
struct AllGive {
  HWY_INLINE hn::Mask<decltype(d)> operator()(hn::Mask<decltype(d)> moves) const { return moves; }
};
struct FlaggedGive {
  unsigned flags;
  HWY_INLINE hn::Mask<decltype(d)> operator()(hn::Mask<decltype(d)> moves) const {
    return hn::And(moves, lanes_of(flags & ((1u << lanes) - 1)));
  }
};

// Factors of the cells in a vector. Bits: those that are not 0.

struct PaperFactors {
  V T, D, axis_limit, diagonal_limit, share;
  explicit PaperFactors(const TalusLaw& law)
      : T(hn::Set(d, law.axis_drop)),
        D(hn::Set(d, law.diagonal_drop)),
        axis_limit(hn::Set(d, law.axis_limit)),
        diagonal_limit(hn::Set(d, law.diagonal_limit)),
        share(hn::Set(d, law.share)) {}

  template <class MayGive>
  HWY_INLINE unsigned operator()(const double* row, int c, double* factors, const MayGive& may_give,
                                 Drops& steepest) const {
    const Around a(row, c);
    const Corners k(row, c);
    const V axis = axis_drop(a), diagonal = diagonal_drop(a.m, k);
    steepest.axis = higher(axis, steepest.axis);
    steepest.diagonal = higher(diagonal, steepest.diagonal);
    const auto moves = may_give(hn::Or(hn::Gt(axis, axis_limit), hn::Gt(diagonal, diagonal_limit)));
    if (hn::AllFalse(d, moves)) {
      hn::Store(hn::Zero(d), d, factors + c);
      return 0;
    }
    const V given = hn::Mul(share, hn::Max(hn::Sub(axis, T), hn::Sub(diagonal, D)));
    const V axis_sum = hn::Add(hn::Add(above(hn::Sub(a.m, a.w), T), above(hn::Sub(a.m, a.e), T)),
                               hn::Add(above(hn::Sub(a.m, a.n), T), above(hn::Sub(a.m, a.s), T)));
    const V diagonal_sum = hn::Add(hn::Add(above(hn::Sub(a.m, k.nw), D), above(hn::Sub(a.m, k.se), D)),
                                   hn::Add(above(hn::Sub(a.m, k.ne), D), above(hn::Sub(a.m, k.sw), D)));
    hn::Store(hn::IfThenElseZero(moves, hn::Div(given, hn::Add(axis_sum, diagonal_sum))), d, factors + c);
    return bits(moves);
  }
};

struct IsotropicFactors {
  V T, limit, surely_at_rest, share, one;
  explicit IsotropicFactors(const TalusLaw& law)
      : T(hn::Set(d, law.axis_drop)),
        limit(hn::Set(d, law.axis_limit)),
        surely_at_rest(hn::Set(d, law.axis_limit * law.axis_limit * (1.0 - 1e-14))),
        share(hn::Set(d, law.share)),
        one(hn::Set(d, 1.0)) {}

  template <class MayGive>
  HWY_INLINE unsigned operator()(const double* row, int c, double* factors, const MayGive& may_give,
                                 Drops& steepest) const {
    const V square = squared_slope(Around(row, c));
    steepest.axis = higher(square, steepest.axis);
    if (hn::AllFalse(d, hn::Gt(square, surely_at_rest))) {
      hn::Store(hn::Zero(d), d, factors + c);
      return 0;
    }
    const V slope = hn::Sqrt(square);
    const auto moves = may_give(hn::Gt(slope, limit));
    const V factor = hn::Mul(share, hn::Sub(one, hn::Div(T, slope)));
    hn::Store(hn::IfThenElseZero(moves, factor), d, factors + c);
    return bits(moves);
  }
};

/// Flags of a row's cells and of its rim's.
using WideRow = GiverFlags::Row;
HWY_INLINE WideRow widened(std::uint64_t row) {
  return {row | row << 1 | row >> 1, (row & 1) != 0, row >> (side - 1) != 0};
}

/// Computes the factors of a row's flagged groups (others keep what they had: no active cell sees them);
/// returns the cells that have one. givers: null = all.
template <class Factors>
HWY_INLINE WideRow factor_row(const Factors& factors_of, TilePatch& patch, int row, const WideRow& cells,
                              const WideRow* givers, Drops& steepest) {
  const double* heights = patch.heights(row);
  double* factors = patch.factors(row);
  const auto one_group = [&](int begin, std::uint64_t may_give) {
    unsigned flags = 0;
    for (int c = 0; c < group; c += lanes) {
      flags |= (givers ? factors_of(heights, begin + c, factors,
                                    FlaggedGive{static_cast<unsigned>(may_give >> c)}, steepest)
                       : factors_of(heights, begin + c, factors, AllGive{}, steepest))
               << c;
    }
    return flags;
  };
  WideRow moving{};
  if (cells.west) {
    const unsigned last = 1u << (group - 1);
    moving.west = (one_group(-group, givers && givers->west ? last : 0) & last) != 0;
  }
  for (unsigned wanted = groups_of(cells.own); wanted; wanted &= wanted - 1) {
    const int begin = std::countr_zero(wanted) * group;
    const unsigned moves = one_group(begin, givers ? givers->own >> begin : 0);
    moving.own |= static_cast<std::uint64_t>(moves) << begin;
  }
  if (cells.east) moving.east = one_group(side, givers && givers->east) & 1;
  return moving;
}

/// What a cell gives to (out) and takes from (in, negative) one neighbour; at most one of them is not 0.
struct Exchange {
  V out, in;
};
HWY_INLINE Exchange exchange(V m, V factor, V neighbour, V neighbour_factor, V threshold, V negative) {
  const V drop = hn::Sub(m, neighbour);
  return {hn::IfThenElseZero(hn::Gt(drop, threshold), hn::Mul(factor, drop)),
          hn::IfThenElseZero(hn::Lt(drop, negative), hn::Mul(neighbour_factor, drop))};
}
HWY_INLINE Exchange sum(const Exchange& a, const Exchange& b) {
  return {hn::Add(a.out, b.out), hn::Add(a.in, b.in)};
}

template <bool diagonals>
struct GainOf {
  V T, minus_T, D, minus_D;
  explicit GainOf(const TalusLaw& law)
      : T(hn::Set(d, diagonals ? law.axis_drop : 0.0)),
        minus_T(hn::Neg(T)),
        D(hn::Set(d, law.diagonal_drop)),
        minus_D(hn::Neg(D)) {}

  /// Inflow less outflow of the flagged cells; adds the outflow to `given`.
  HWY_INLINE V operator()(const double* row, const double* factors, int c, hn::Mask<decltype(d)> cells,
                          V& given) const {
    const Around m(row, c), f(factors, c);
    Exchange all =
        sum(sum(exchange(m.m, f.m, m.w, f.w, T, minus_T), exchange(m.m, f.m, m.e, f.e, T, minus_T)),
            sum(exchange(m.m, f.m, m.n, f.n, T, minus_T), exchange(m.m, f.m, m.s, f.s, T, minus_T)));
    if constexpr (diagonals) {
      const Corners k(row, c), fk(factors, c);
      all = sum(
          all,
          sum(sum(exchange(m.m, f.m, k.nw, fk.nw, D, minus_D), exchange(m.m, f.m, k.se, fk.se, D, minus_D)),
              sum(exchange(m.m, f.m, k.ne, fk.ne, D, minus_D), exchange(m.m, f.m, k.sw, fk.sw, D, minus_D))));
    }
    given = hn::Add(given, hn::IfThenElseZero(cells, all.out));
    return hn::IfThenElseZero(cells, hn::Neg(hn::Add(all.in, all.out)));
  }
};

HWY_INLINE double total(const V (&sums)[group / lanes]) {
  alignas(64) double lane[group];
  for (int c = 0; c < group; c += lanes) hn::Store(sums[c / lanes], d, lane + c);
  return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

HWY_INLINE double largest(V v) { return hn::GetLane(hn::MaxOfLanes(d, v)); }

template <class Factors, class Gain>
HWY_INLINE void flow_of(const TalusLaw& law, TilePatch& patch, const CellFlags& active,
                        const GiverFlags* givers, TileFlow& flow) {
  const RowSpan span = row_span(active);
  const auto active_row = [&](int row) { return row < 0 || row >= side ? 0 : active[row]; };
  std::array<WideRow, side + 2> moving;  // from row -1; those around the span
  const Factors factors(law);
  Drops steepest;
  for (int row = span.begin - 1; row <= span.end; ++row)
    moving[row + 1] =
        factor_row(factors, patch, row, widened(active_row(row - 1) | active_row(row) | active_row(row + 1)),
                   givers ? &givers->rows[row + 1] : nullptr, steepest);

  const Gain gain(law);
  V given[group / lanes];
  for (V& of_lane : given) of_lane = hn::Zero(d);
  flow.moved = {};
  for (int row = span.begin; row < span.end; ++row) {
    const WideRow &n = moving[row], &m = moving[row + 1], &s = moving[row + 2];
    const std::uint64_t own = n.own | m.own | s.own;
    const std::uint64_t west = n.west || m.west || s.west, east = n.east || m.east || s.east;
    const std::uint64_t cells = (own | own << 1 | own >> 1 | west | east << (side - 1)) & active[row];
    flow.moved[row] = cells;
    for (unsigned wanted = groups_of(cells); wanted; wanted &= wanted - 1) {
      const int begin = std::countr_zero(wanted) * group;
      for (int c = 0; c < group; c += lanes) {
        const auto flagged = lanes_of(static_cast<unsigned>(cells >> (begin + c)) & ((1u << lanes) - 1));
        hn::Store(gain(patch.heights(row), patch.factors(row), begin + c, flagged, given[c / lanes]), d,
                  flow.gain.data() + row * side + begin + c);
      }
    }
  }
  flow.given = total(given);
  flow.axis_drop =
      law.law == RelaxationLaw::paper ? largest(steepest.axis) : std::sqrt(largest(steepest.axis));
  flow.diagonal_drop = largest(steepest.diagonal);
}

void ComputeFlow(const TalusLaw& law, TilePatch& patch, const CellFlags& active, const GiverFlags* givers,
                 TileFlow& flow) {
  if (law.law == RelaxationLaw::paper) {
    flow_of<PaperFactors, GainOf<true>>(law, patch, active, givers, flow);
  } else {
    flow_of<IsotropicFactors, GainOf<false>>(law, patch, active, givers, flow);
  }
}

bool ApplyFlow(const TileFlow& flow, double* heights, CellFlags& changed) {
  bool any = false;
  changed = {};
  const RowSpan span = row_span(flow.moved);
  for (int row = span.begin; row < span.end; ++row) {
    std::uint64_t flags = 0;
    for (unsigned wanted = groups_of(flow.moved[row]); wanted; wanted &= wanted - 1) {
      const int begin = std::countr_zero(wanted) * group;
      for (int c = 0; c < group; c += lanes) {
        double* cell = heights + row * side + begin + c;
        const V old = hn::Load(d, cell);
        const V next = hn::Add(old, hn::Load(d, flow.gain.data() + row * side + begin + c));
        hn::Store(next, d, cell);
        flags |= static_cast<std::uint64_t>(bits(hn::Ne(next, old))) << (begin + c);
      }
    }
    changed[row] = flags;
    any |= flags != 0;
  }
  return any;
}

void ComputeResiduals(const TalusLaw& law, const TilePatch& patch, const CellFlags& cells, double* steepest) {
  const bool paper = law.law == RelaxationLaw::paper;
  const RowSpan span = row_span(cells);
  for (int row = span.begin; row < span.end; ++row) {
    for (unsigned wanted = groups_of(cells[row]); wanted; wanted &= wanted - 1) {
      const int g = std::countr_zero(wanted);
      Drops drops;
      for (int c = g * group; c < (g + 1) * group; c += lanes) {
        const Around a(patch.heights(row), c);
        drops.axis = higher(paper ? axis_drop(a) : squared_slope(a), drops.axis);
        if (paper)
          drops.diagonal = higher(diagonal_drop(a.m, Corners(patch.heights(row), c)), drops.diagonal);
      }
      const double axis = largest(drops.axis), diagonal = largest(drops.diagonal);
      steepest[row * groups + g] = paper ? std::max(axis / law.axis_drop, diagonal / law.diagonal_drop) - 1.0
                                         : std::sqrt(axis) / law.axis_drop - 1.0;
    }
  }
}

/// Calls body(row, group) for the groups that `groups(row)` flags.
template <class Groups, class Body>
HWY_INLINE void for_groups(const Groups& groups_in, const Body& body) {
  for (int row = 0; row < side; ++row)
    for (unsigned wanted = groups_in(row); wanted; wanted &= wanted - 1) body(row, std::countr_zero(wanted));
}

/// max |F - F0| and sum F F0, lane by lane.
struct Comparison {
  V difference, products[group / lanes];
  HWY_INLINE Comparison() : difference(hn::Zero(d)) {
    for (V& of_lane : products) of_lane = hn::Zero(d);
  }
  HWY_INLINE void add(int lane, V subtracted, V factor, V gain) {
    difference = hn::Max(difference, hn::Abs(hn::Sub(gain, subtracted)));
    products[lane / lanes] = hn::Add(products[lane / lanes], hn::Mul(gain, factor));
  }
  HWY_INLINE FlowChange all() const { return {largest(difference), total(products)}; }
};

FlowChange KeepFirstFlow(const TileFlow& flow, SuperStepTile& tile) {
  Comparison first;
  for (int row = 0; row < side; ++row)
    tile.first_moved[row] = static_cast<std::uint8_t>(groups_of(flow.moved[row]));
  for_groups([&](int row) { return tile.first_moved[row]; },
             [&](int row, int g) {
               for (int c = 0; c < group; c += lanes) {
                 const int at = row * side + g * group + c;
                 const V gain = hn::Load(d, flow.gain.data() + at);
                 first.add(c, hn::Zero(d), gain, gain);
                 hn::Store(gain, d, tile.first_gain.data() + at);
               }
             });
  return first.all();
}

FlowChange CompareFlows(const TileFlow& flow, const SuperStepTile& tile) {
  Comparison change;
  for_groups([&](int row) { return groups_of(flow.moved[row]) | tile.first_moved[row]; },
             [&](int row, int g) {
               const bool now = groups_of(flow.moved[row]) >> g & 1, first = tile.first_moved[row] >> g & 1;
               for (int c = 0; c < group; c += lanes) {
                 const int at = row * side + g * group + c;
                 const V gain = now ? hn::Load(d, flow.gain.data() + at) : hn::Zero(d);
                 const V before = first ? hn::Load(d, tile.first_gain.data() + at) : hn::Zero(d);
                 change.add(c, before, before, gain);
               }
             });
  return change.all();
}

/// Lowest and highest, lane by lane.
struct Range {
  V low, high;
  HWY_INLINE Range() : low(hn::Set(d, std::numeric_limits<double>::infinity())), high(hn::Neg(low)) {}
  HWY_INLINE void add(V heights, hn::Mask<decltype(d)> counts) {
    low = hn::IfThenElse(counts, hn::Min(low, heights), low);
    high = hn::IfThenElse(counts, hn::Max(high, heights), high);
  }
  HWY_INLINE HeightRange all() const { return {hn::GetLane(hn::MinOfLanes(d, low)), largest(high)}; }
};

HeightRange RangeOf(const double* heights, int rows, int cols) {
  Range range;
  for (int row = 0; row < rows; ++row)
    for (int c = 0; c < cols; c += lanes)
      range.add(hn::Load(d, heights + row * side + c), hn::FirstN(d, static_cast<std::size_t>(cols - c)));
  return range.all();
}

HeightRange SuperStage(const TileFlow& flow, const CellFlags& active, double momentum, double step,
                       double* heights, SuperStepTile& tile, CellFlags& changed) {
  const V momentum_of_one = hn::Set(d, momentum), step_of_one = hn::Set(d, step);
  Range range;
  changed = {};
  for_groups([&](int row) { return groups_of(active[row]); },
             [&](int row, int g) {
               const bool moved = groups_of(flow.moved[row]) >> g & 1, stepped = tile.stepped[row] >> g & 1;
               for (int c = g * group; c < (g + 1) * group; c += lanes) {
                 const int at = row * side + c;
                 const V now = hn::Load(d, heights + at);
                 V next = now;
                 if (stepped) {
                   const V before = hn::Load(d, tile.before.data() + at);
                   next = hn::Add(next, hn::Mul(momentum_of_one, hn::Sub(now, before)));
                 }
                 if (moved) next = hn::Add(next, hn::Mul(step_of_one, hn::Load(d, flow.gain.data() + at)));
                 hn::Store(now, d, tile.before.data() + at);
                 hn::Store(next, d, heights + at);
                 range.add(next, lanes_of(static_cast<unsigned>(active[row] >> c) & ((1u << lanes) - 1)));
                 changed[row] |= static_cast<std::uint64_t>(bits(hn::Ne(next, now))) << c;
               }
             });
  for (int row = 0; row < side; ++row) tile.stepped[row] |= static_cast<std::uint8_t>(groups_of(active[row]));
  return range.all();
}

void TakeBackStage(const SuperStepTile& tile, double* heights) {
  for_groups([&](int row) { return tile.stepped[row]; },
             [&](int row, int g) {
               for (int at = row * side + g * group, end = at + group; at < end; at += lanes)
                 hn::Store(hn::Load(d, tile.before.data() + at), d, heights + at);
             });
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sandstroke {

HWY_EXPORT(ComputeFlow);
HWY_EXPORT(ApplyFlow);
HWY_EXPORT(ComputeResiduals);
HWY_EXPORT(KeepFirstFlow);
HWY_EXPORT(CompareFlows);
HWY_EXPORT(RangeOf);
HWY_EXPORT(SuperStage);
HWY_EXPORT(TakeBackStage);

void compute_flow(const TalusLaw& law, TilePatch& patch, const CellFlags& active, const GiverFlags* givers,
                  TileFlow& flow) {
  HWY_DYNAMIC_DISPATCH(ComputeFlow)(law, patch, active, givers, flow);
}
FlowChange keep_first_flow(const TileFlow& flow, SuperStepTile& tile) {
  return HWY_DYNAMIC_DISPATCH(KeepFirstFlow)(flow, tile);
}
FlowChange compare_flows(const TileFlow& flow, const SuperStepTile& tile) {
  return HWY_DYNAMIC_DISPATCH(CompareFlows)(flow, tile);
}
HeightRange range_of(const double* heights, int rows, int cols) {
  return HWY_DYNAMIC_DISPATCH(RangeOf)(heights, rows, cols);
}
HeightRange super_stage(const TileFlow& flow, const CellFlags& active, double momentum, double step,
                        double* heights, SuperStepTile& tile, CellFlags& changed) {
  return HWY_DYNAMIC_DISPATCH(SuperStage)(flow, active, momentum, step, heights, tile, changed);
}
bool apply_flow(const TileFlow& flow, double* heights, CellFlags& changed) {
  return HWY_DYNAMIC_DISPATCH(ApplyFlow)(flow, heights, changed);
}
void compute_residuals(const TalusLaw& law, const TilePatch& patch, const CellFlags& cells,
                       double* steepest) {
  HWY_DYNAMIC_DISPATCH(ComputeResiduals)(law, patch, cells, steepest);
}
void take_back_stage(const SuperStepTile& tile, double* heights) {
  HWY_DYNAMIC_DISPATCH(TakeBackStage)(tile, heights);
}

}  // namespace sandstroke
#endif
