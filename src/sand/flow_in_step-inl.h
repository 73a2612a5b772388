// Policies of the sweep over a flow: what it records besides, and where it puts the gains. Included once per
// instruction set, like lanes-inl.h.
#if defined(SANDSTROKE_SAND_FLOW_IN_STEP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SANDSTROKE_SAND_FLOW_IN_STEP_INL_H_
#undef SANDSTROKE_SAND_FLOW_IN_STEP_INL_H_
#else
#define SANDSTROKE_SAND_FLOW_IN_STEP_INL_H_
#endif

#include <cmath>

#include "sand/flow_kernels.h"
#include "sand/stage-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

constexpr int side = BedGeometry::tile_side;

/// The higher of both; a wall (NaN) as `a` is ignored.
HWY_INLINE V higher(V a, V b) {
#if HWY_ARCH_X86
  return hn::Max(a, b);
#else
  return hn::IfThenElse(a > b, a, b);
#endif
}

/// The largest drops found so far, per lane. For isotropic and faces, axis holds the largest square of dx
/// |g|.
struct Drops {
  V axis, diagonal;
  HWY_INLINE Drops() : axis(hn::Zero(d)), diagonal(hn::Zero(d)) {}
};

/// Flags of a row's cells, and of the rim cell on each side.
using WideRow = FlowScratch::Row;
HWY_INLINE WideRow widened(std::uint64_t row) {
  return {row | row << 1 | row >> 1, (row & 1) != 0, row >> (side - 1) != 0};
}

/// The flagged cells of a row from column c on.
HWY_INLINE Mask cells_from(const WideRow& flags, int c) {
  const std::uint64_t west = flags.west, east = flags.east;
  if (c < 0) return lanes_of(west << (-c - 1) | flags.own << -c);
  if (c >= side) return lanes_of(east >> (c - side));
  return lanes_of(c == 0 ? flags.own : flags.own >> c | east << (side - c));
}

// The following types say which cells may give, and what is recorded besides.

/// Plain passes: every cell may give, and nothing is recorded.
struct FreeSand {
  HWY_INLINE WideRow givers(int) const { return {~std::uint64_t{0}, true, true}; }
  HWY_INLINE Mask may_give(int, int) const { return hn::FirstN(d, lanes); }
  HWY_INLINE void meet(V, V) {}
  HWY_INLINE void flows(int, int, V) {}
  HWY_INLINE void ends(int, unsigned) {}
  HWY_INLINE void report(const TalusLaw&, TileFlow&) {}
};

/// Super-steps: flagged cells may give. Records how steep the sand is, and how its flow differs from the
/// first one.
class SteppedSand {
 public:
  SteppedSand(const FirstFlow& first, const FlowScratch& scratch)
      : first_(first), givers_(scratch.givers.data()), difference_(hn::Zero(d)) {}
  HWY_INLINE WideRow givers(int row) const { return givers_[row + 1]; }
  HWY_INLINE Mask may_give(int row, int c) const { return cells_from(givers_[row + 1], c); }
  HWY_INLINE void meet(V axis, V diagonal) {
    steepest_.axis = higher(axis, steepest_.axis);
    steepest_.diagonal = higher(diagonal, steepest_.diagonal);
  }
  HWY_INLINE void flows(int row, int c, V gain) {
    if (!(first_.moved[row] >> (c / group) & 1)) {
      difference_ = Max(difference_, hn::Abs(gain));
      return;
    }
    const V before = hn::Load(d, first_.gain.data() + row * side + c);
    difference_ = Max(difference_, hn::Abs(gain - before));
    product_.add(c, gain * before);
  }
  /// Records the groups of the row that flowed at first and do not flow any more.
  HWY_INLINE void ends(int row, unsigned moved) {
    for_vectors(first_.moved[row] & ~moved, [&](int c) {
      difference_ = Max(difference_, hn::Abs(hn::Load(d, first_.gain.data() + row * side + c)));
    });
  }
  HWY_INLINE void report(const TalusLaw& law, TileFlow& flow) {
    for (int row = first_.rows.begin; row < first_.rows.end; ++row)
      if (row < flow.rows.begin || row >= flow.rows.end) ends(row, 0);
    const double axis = largest(steepest_.axis);
    flow.axis_drop = law.law == RelaxationLaw::paper ? axis : std::sqrt(axis);
    flow.diagonal_drop = largest(steepest_.diagonal);
    flow.change = largest(difference_);
    flow.product = product_.total();
  }

 private:
  const FirstFlow& first_;
  const FlowScratch::Row* givers_;
  Drops steepest_;
  V difference_;
  LaneSum product_;
};

/// Super-steps over a floor: what counts of a cell's gain is told afterwards (count_flows).
class SteppedOverFloor : public SteppedSand {
 public:
  using SteppedSand::SteppedSand;
  HWY_INLINE void flows(int, int, V) {}
  HWY_INLINE void report(const TalusLaw&, TileFlow&) {}
};

// The following types say where the gains of the active cells go.

/// Keeps the gains in the flow.
class KeptGain {
 public:
  explicit KeptGain(TileFlow& flow) : gain_(flow.gain.data()) {}
  HWY_INLINE void begin_row(int row, std::uint64_t) { row_ = gain_ + row * side; }
  HWY_INLINE void take(int c, V gain) { hn::Store(gain, d, row_ + c); }
  HWY_INLINE void end_row(int, unsigned) {}
  HWY_INLINE void end(RowSpan) {}

 private:
  double *gain_, *row_ = nullptr;
};

/// Drops the gains.
struct NoGain {
  HWY_INLINE void begin_row(int, std::uint64_t) {}
  HWY_INLINE void take(int, V) {}
  HWY_INLINE void end_row(int, unsigned) {}
  HWY_INLINE void end(RowSpan) {}
};

/// Takes the stage ahead with them, as super_stage does, but writes it into the other heights (tile.before).
class TakenStage {
 public:
  TakenStage(const TilePatch& patch, const StageAhead& ahead)
      : patch_(patch), ahead_(ahead), momentum_(all(ahead.momentum)), step_(all(ahead.step)) {}
  HWY_INLINE void begin_row(int row, std::uint64_t active) {
    now_ = patch_.heights(row);
    out_ = ahead_.tile.before->row(row);
    active_ = active;
    changed_ = 0;
    stepped_ = ahead_.tile.stepped[row];
  }
  HWY_INLINE void take(int c, V gain) {
    const V now = hn::Load(d, now_ + c);
    take(c, now, momentum_of(c, now) + step_ * gain);
  }
  HWY_INLINE void end_row(int row, unsigned moved) {
    const unsigned wanted = groups_of(active_);
    for_vectors(wanted & ~moved, [&](int c) {
      const V now = hn::Load(d, now_ + c);
      take(c, now, momentum_of(c, now));
    });
    ahead_.changed[row] = changed_ & active_;  // a wall (NaN) beside them always compares as changed
    ahead_.tile.stepped[row] |= static_cast<std::uint8_t>(wanted);
    copy_others(row, wanted);
  }
  HWY_INLINE void end(RowSpan rows) {
    const RowSpan loaded = patch_.loaded_rows();
    for (int row = loaded.begin; row < rows.begin; ++row) copy_others(row, 0);
    for (int row = rows.end; row < loaded.end; ++row) copy_others(row, 0);
    ahead_.tile.rows = joined(ahead_.tile.rows, rows);
    ahead_.range = range_.over_lanes();
  }

 private:
  HWY_INLINE V momentum_of(int c, V now) const {
    return with_momentum(now, stepped_ >> (c / group) & 1, momentum_, out_ + c);
  }
  HWY_INLINE void take(int c, V now, V next) {
    hn::Store(next, d, out_ + c);
    range_.add(next, lanes_of(active_ >> c));
    changed_ |= static_cast<std::uint64_t>(bits(next != now)) << c;
  }
  /// Copies the groups that are not active to the other heights.
  HWY_INLINE void copy_others(int row, unsigned active) {
    std::uint8_t& same = ahead_.tile.same[row];
    const double* from = patch_.heights(row);
    double* to = ahead_.tile.before->row(row);
    for_vectors(~(active | same) & 0xffu, [&](int c) { hn::Store(hn::Load(d, from + c), d, to + c); });
    same = static_cast<std::uint8_t>(~active);
  }

  const TilePatch& patch_;
  const StageAhead& ahead_;
  V momentum_, step_;
  Range range_;
  // State of the current row.
  const double* now_ = nullptr;
  double* out_ = nullptr;
  std::uint64_t active_ = 0, changed_ = 0;
  unsigned stepped_ = 0;
};

/// Sweeps once over the active rows. cells_of(row) returns the cells that gain or give, as flags, and
/// prepares what gain_of needs of the row. gain_of(row, column, those cells, given) returns the gains of a
/// vector of cells [m], and adds what they give to `given`.
template <class Sand, class Sink, class CellsOf, class GainOf>
HWY_INLINE void sweep_rows(const TalusLaw& law, const CellFlags& active, RowSpan rows, Sand& sand, Sink& sink,
                           TileFlow& flow, const CellsOf& cells_of, const GainOf& gain_of) {
  LaneSum given;
  flow.rows = rows;
  for (int row = rows.begin; row < rows.end; ++row) {
    const std::uint64_t cells = cells_of(row) & active[row];
    flow.moved[row] = cells;
    const unsigned moved = groups_of(cells);
    sink.begin_row(row, active[row]);
    for_vectors(moved, [&](int c) {
      const V gained = gain_of(row, c, lanes_of(cells >> c), given);
      sink.take(c, gained);
      sand.flows(row, c, gained);
    });
    sand.ends(row, moved);
    sink.end_row(row, moved);
  }
  sink.end(rows);
  flow.given = given.total();
  sand.report(law, flow);
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#endif
