// The fast form of talus_pass (rules/talus.h): only cells that may move, many at once.
// tests/sand/engine_equality_test.cpp and tests/run/golden_engine_test.cpp check that both give the same
// bits.
#include "sand/flow_kernels.h"

#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/flow_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sand/face_flow-inl.h"
#include "sand/face_flow_on_ground-inl.h"
#include "sand/law_on_ground-inl.h"
#include "sand/slopes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

HWY_INLINE V above(V x, V threshold) { return where(x > threshold, x); }

// The following types compute the factors of the cells in a vector: a cell gives each lower neighbour factor
// x (m - m_i). They return flags of the factors that are not 0.

/// dm = c max_i(m - m_i - T_i), shared in proportion to m - m_i: the factor is dm / sum(m - m_i), over
/// neighbours with m - m_i > T_i (paper 3.2).
struct PaperFactors {
  V T, D, axis_limit, diagonal_limit, share;
  explicit PaperFactors(const TalusLaw& law)
      : T(all(law.axis_drop)),
        D(all(law.diagonal_drop)),
        axis_limit(all(law.axis_limit)),
        diagonal_limit(all(law.diagonal_limit)),
        share(all(law.share)) {}

  template <class Sand>
  HWY_INLINE unsigned operator()(const double* row, int, int c, double* factors, Mask may_give,
                                 Sand& sand) const {
    const Around a(row, c);
    const Corners k(row, c);
    const V axis = axis_drop(a), diagonal = diagonal_drop(a.m, k);
    sand.meet(axis, diagonal);
    const Mask moves = hn::And(may_give, hn::Or(axis > axis_limit, diagonal > diagonal_limit));
    if (hn::AllFalse(d, moves)) {
      hn::Store(hn::Zero(d), d, factors + c);
      return 0;
    }
    const V dm = share * Max(axis - T, diagonal - D);
    const V axis_sum =
        (above(a.m - a.w, T) + above(a.m - a.e, T)) + (above(a.m - a.n, T) + above(a.m - a.s, T));
    const V diagonal_sum =
        (above(a.m - k.nw, D) + above(a.m - k.se, D)) + (above(a.m - k.ne, D) + above(a.m - k.sw, D));
    hn::Store(where(moves, dm / (axis_sum + diagonal_sum)), d, factors + c);
    return bits(moves);
  }
};

/// The factor is c (1 - T / |g|), with |g| as a drop. by_cell: each cell weighs its |g|^2.
template <bool by_cell>
struct IsotropicFactors {
  V T, limit, surely_at_rest, share, one;
  const TilePatch* weights;
  explicit IsotropicFactors(const TalusLaw& law, const TilePatch* slope_weights = nullptr)
      : T(all(law.axis_drop)),
        limit(all(law.axis_limit)),
        surely_at_rest(all(law.axis_limit * law.axis_limit * (1.0 - 1e-14))),
        share(all(law.share)),
        one(all(1.0)),
        weights(slope_weights) {}

  template <class Sand>
  HWY_INLINE unsigned operator()(const double* heights, int row, int c, double* factors, Mask may_give,
                                 Sand& sand) const {
    V square = squared_slope(Around(heights, c));
    if constexpr (by_cell) square *= hn::Load(d, weights->heights(row) + c);
    sand.meet(square, hn::Zero(d));
    if (hn::AllFalse(d, square > surely_at_rest)) {
      hn::Store(hn::Zero(d), d, factors + c);
      return 0;
    }
    const V g = Sqrt(square);
    const Mask moves = hn::And(may_give, g > limit);
    hn::Store(where(moves, share * (one - T / g)), d, factors + c);
    return bits(moves);
  }
};

/// Computes the factors of eight cells. Returns flags of those that are not 0.
template <class Factors, class Sand>
HWY_INLINE unsigned factor_group(const Factors& factors_of, const double* heights, double* factors, int row,
                                 int begin, Sand& sand) {
  unsigned flags = 0;
  for (int c = begin; c < begin + group; c += lanes)
    flags |= factors_of(heights, row, c, factors, sand.may_give(row, c), sand) << (c - begin);
  return flags;
}

/// Computes the factors of a row's flagged groups. (Others keep their old factors, which no active cell
/// sees.) Returns the cells whose factor is not 0.
template <class Factors, class Sand>
HWY_INLINE WideRow factor_row(const Factors& factors_of, const double* heights, double* factors, int row,
                              const WideRow& cells, Sand& sand) {
  WideRow moving{};
  if (cells.west)
    moving.west = (factor_group(factors_of, heights, factors, row, -group, sand) >> (group - 1)) & 1;
  for (unsigned wanted = groups_of(cells.own); wanted; wanted &= wanted - 1) {
    const int begin = std::countr_zero(wanted) * group;
    const std::uint64_t flags = factor_group(factors_of, heights, factors, row, begin, sand);
    moving.own |= flags << begin;
  }
  if (cells.east) moving.east = factor_group(factors_of, heights, factors, row, side, sand) & 1;
  return moving;
}

template <bool diagonals>
struct GainOf {
  V T, minus_T, D, minus_D;
  explicit GainOf(const TalusLaw& law)
      : T(all(diagonals ? law.axis_drop : 0.0)),
        minus_T(hn::Neg(T)),
        D(all(law.diagonal_drop)),
        minus_D(hn::Neg(D)) {}

  /// Returns inflow less outflow of the flagged cells; adds the outflow to `given`.
  HWY_INLINE V operator()(const double* row, const double* factors, int, int c, Mask cells,
                          LaneSum& given) const {
    const Around m(row, c), f(factors, c);
    const auto axis = [&](V m_i, V f_i) { return exchange(m.m, f.m, m_i, f_i, T, minus_T); };
    Exchange flow = (axis(m.w, f.w) + axis(m.e, f.e)) + (axis(m.n, f.n) + axis(m.s, f.s));
    if constexpr (diagonals) {
      const Corners k(row, c), fk(factors, c);
      const auto diagonal = [&](V m_i, V f_i) { return exchange(m.m, f.m, m_i, f_i, D, minus_D); };
      flow = flow + ((diagonal(k.nw, fk.nw) + diagonal(k.se, fk.se)) +
                     (diagonal(k.ne, fk.ne) + diagonal(k.sw, fk.sw)));
    }
    given.add(c, where(cells, flow.out));
    return where(cells, hn::Neg(flow.in + flow.out));
  }
};

template <class Factors, class Gain, class Sand, class Sink>
HWY_INLINE void flow_of(const Factors& factors, const Gain& gain, const TalusLaw& law, const TilePatch& patch,
                        const CellFlags& active, RowSpan rows, Sand& sand, Sink& sink, FlowScratch& scratch,
                        TileFlow& flow) {
  const auto active_row = [&](int row) { return row < rows.begin || row >= rows.end ? 0 : active[row]; };
  const auto factors_in = [&](int row) { return scratch.factors.data() + TilePatch::start(row); };
  std::array<WideRow, side + 2> moving;  // from row -1: the rows of the span and one on each side
  for (int row = rows.begin - 1; row <= rows.end; ++row)
    moving[row + 1] = factor_row(factors, patch.heights(row), factors_in(row), row,
                                 widened(active_row(row - 1) | active_row(row) | active_row(row + 1)), sand);

  const auto cells_of = [&](int row) {
    const WideRow &n = moving[row], &m = moving[row + 1], &s = moving[row + 2];
    const std::uint64_t own = n.own | m.own | s.own;
    const std::uint64_t west = n.west || m.west || s.west, east = n.east || m.east || s.east;
    return own | own << 1 | own >> 1 | west | east << (side - 1);
  };
  sweep_rows(law, active, rows, sand, sink, flow, cells_of, [&](int row, int c, Mask cells, LaneSum& given) {
    return gain(patch.heights(row), factors_in(row), row, c, cells, given);
  });
}

/// even: where GroundPatch::has_only() the law's T, if it is worth a kernel of its own.
template <bool even, class Sand, class Sink>
HWY_INLINE void flow_on_ground(const TalusLaw& law, const TilePatch& patch, const CellFlags& active,
                               RowSpan rows, const GroundPatch& ground, Sand& sand, Sink& sink,
                               FlowScratch& scratch, TileFlow& flow) {
  scratch.films = {};
  switch (law.law) {
    case RelaxationLaw::paper:
      return flow_of(PaperOnGround(law, ground), PaperGainOnGround(law, ground), law, patch, active, rows,
                     sand, sink, scratch, flow);
    case RelaxationLaw::isotropic:
      return flow_of(IsotropicOnGround(law, ground, scratch), GainOf<false>(law), law, patch, active, rows,
                     sand, sink, scratch, flow);
    case RelaxationLaw::faces:
      return face_flow_on_ground<even>(law, patch, active, rows, ground, sand, sink, scratch, flow);
  }
}

/// Keeps what flows through the faces of the cells that moved. A face through which sand flows is beside two
/// of them.
void keep_fluxes(const TalusLaw& law, const TilePatch& patch, const TileFlow& flow,
                 const FlowScratch& scratch, TileFluxes& fluxes) {
  fluxes.clear();
  if (!flow.rows.empty()) fluxes.rows = {flow.rows.begin - 1, flow.rows.end};
  if (flow.rows.begin == 0 && !flow.rows.empty())
    fluxes.groups[0] = static_cast<std::uint16_t>(groups_of(flow.moved[0]) << 1);
  for (int row = flow.rows.begin; row < flow.rows.end; ++row)
    fluxes.groups[row + 1] =
        static_cast<std::uint16_t>(groups_of(flow.moved[row]) << 1 | (flow.moved[row] & 1));
  const auto keep = [&](int row, int c, Mask cells, int down) {
    const auto at = [&](const auto& values, int r, int col) {
      return hn::LoadU(d, values.data() + TilePatch::start(r) + col);
    };
    const int next_row = row + down, next_col = c + 1 - down;
    V flux;
    if (law.law == RelaxationLaw::faces) {
      flux = at(down ? scratch.below : scratch.factors, row, c);
    } else {
      const V drop = hn::LoadU(d, patch.heights(row) + c) - hn::LoadU(d, patch.heights(next_row) + next_col);
      flux = exchanged(drop, at(scratch.factors, row, c), at(scratch.factors, next_row, next_col));
    }
    PatchHeights& out = down ? *fluxes.below : *fluxes.right;
    hn::Store(where(hn::And(cells, flux == flux), flux), d, out.row(row) + c);
  };
  for (int row = flow.rows.begin; row < flow.rows.end; ++row) {
    const std::uint64_t moved = flow.moved[row];
    if (row == 0) for_vectors(groups_of(moved), [&](int c) { keep(-1, c, lanes_of(moved >> c), 1); });
    if (moved & 1)
      for (int c = -group; c < 0; c += lanes)
        keep(row, c, lanes_of(c + lanes == 0 ? std::uint64_t{1} << (lanes - 1) : 0), 0);
    for_vectors(groups_of(moved), [&](int c) {
      keep(row, c, lanes_of(moved >> c), 0);
      keep(row, c, lanes_of(moved >> c), 1);
    });
  }
}

/// Tells the step's controller what cells gain, but for films and what they give.
void count_flows(const TileFluxes& fluxes, const FlowScratch& scratch, const TalusLaw& law, SteppedSand& sand,
                 TileFlow& flow) {
  const V zero = hn::Zero(d);
  for (int row = flow.rows.begin; row < flow.rows.end; ++row)
    for_vectors(groups_of(flow.moved[row]), [&](int c) {
      const auto film = [&](int r, int col) { return cells_from(scratch.films[r + 1], col); };
      CellFaces faces(fluxes.right->row(row) + c, fluxes.below->row(row) + c);
      const auto leave_out = [](V& into_the_cell, Mask given_by_a_film) {
        into_the_cell = hn::IfThenZeroElse(given_by_a_film, into_the_cell);
      };
      leave_out(faces.east, hn::And(faces.east < zero, film(row, c + 1)));
      leave_out(faces.west, hn::And(faces.west > zero, film(row, c - 1)));
      leave_out(faces.south, hn::And(faces.south < zero, film(row + 1, c)));
      leave_out(faces.north, hn::And(faces.north > zero, film(row - 1, c)));
      const V gain = hn::IfThenZeroElse(film(row, c), faces.gained());
      hn::Store(gain, d, flow.gain.data() + row * side + c);
      sand.flows(row, c, gain);
    });
  sand.report(law, flow);
}

void ComputeFlow(const TalusLaw& law, const TilePatch& patch, const CellFlags& active, RowSpan rows,
                 const FlowInStep& in_step, FlowScratch& scratch, TileFlow& flow) {
  const auto compute = [&](auto sand, auto sink) {
    if (in_step.ground)
      return flow_on_ground<false>(law, patch, active, rows, *in_step.ground, sand, sink, scratch, flow);
    switch (law.law) {
      case RelaxationLaw::paper:
        return flow_of(PaperFactors(law), GainOf<true>(law), law, patch, active, rows, sand, sink, scratch,
                       flow);
      case RelaxationLaw::isotropic:
        if (in_step.slope_weights)
          return flow_of(IsotropicFactors<true>(law, in_step.slope_weights), GainOf<false>(law), law, patch,
                         active, rows, sand, sink, scratch, flow);
        return flow_of(IsotropicFactors<false>(law), GainOf<false>(law), law, patch, active, rows, sand, sink,
                       scratch, flow);
      case RelaxationLaw::faces:
        return face_flow(law, patch, active, rows, sand, sink, scratch, flow);
    }
  };
  if (!in_step.first) {
    compute(FreeSand{}, KeptGain(flow));
  } else if (in_step.fluxes) {
    SteppedOverFloor sand(*in_step.first, scratch);
    NoGain sink;
    if (in_step.ground->has_only(law.axis_drop))
      flow_on_ground<true>(law, patch, active, rows, *in_step.ground, sand, sink, scratch, flow);
    else
      flow_on_ground<false>(law, patch, active, rows, *in_step.ground, sand, sink, scratch, flow);
    keep_fluxes(law, patch, flow, scratch, *in_step.fluxes);
    count_flows(*in_step.fluxes, scratch, law, sand, flow);
  } else if (!in_step.ahead) {
    compute(SteppedSand(*in_step.first, scratch), KeptGain(flow));
  } else {
    compute(SteppedSand(*in_step.first, scratch), TakenStage(patch, *in_step.ahead));
  }
}

/// ground: null where there is none.
template <bool on_ground>
HWY_INLINE void apply(const TileFlow& flow, const GroundPatch* ground, TilePatch& patch, CellFlags& changed) {
  for (int row = flow.rows.begin; row < flow.rows.end; ++row) {
    std::uint64_t flags = 0;
    for_vectors(groups_of(flow.moved[row]), [&](int c) {
      double* cell = patch.heights(row) + c;
      const V old = hn::Load(d, cell);
      V next = old + hn::Load(d, flow.gain.data() + row * side + c);
      if (on_ground) {
        const V floor = hn::Load(d, ground->floor.row(row) + c);
        next = hn::IfThenElse(next < floor, floor, next);  // walls stay NaN
      }
      hn::Store(next, d, cell);
      flags |= static_cast<std::uint64_t>(bits(next != old)) << c;
    });
    changed[row] = flags & flow.moved[row];  // a wall (NaN) beside them always compares as changed
  }
}
void ApplyFlow(const TileFlow& flow, const GroundPatch* ground, TilePatch& patch, CellFlags& changed) {
  return ground ? apply<true>(flow, ground, patch, changed) : apply<false>(flow, ground, patch, changed);
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sandstroke {

HWY_EXPORT(ComputeFlow);
HWY_EXPORT(ApplyFlow);

FlowScratch& FlowScratch::of_this_thread() {
  thread_local FlowScratch scratch;
  return scratch;
}

void compute_flow(const TalusLaw& law, const TilePatch& patch, const CellFlags& active, RowSpan rows,
                  const FlowInStep& in_step, FlowScratch& scratch, TileFlow& flow) {
  HWY_DYNAMIC_DISPATCH(ComputeFlow)(law, patch, active, rows, in_step, scratch, flow);
}
void apply_flow(const TileFlow& flow, const GroundPatch* ground, TilePatch& patch, CellFlags& changed) {
  HWY_DYNAMIC_DISPATCH(ApplyFlow)(flow, ground, patch, changed);
}

}  // namespace sandstroke
#endif
