#include "sand/super_step_kernels.h"

#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/super_step_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sand/stage-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

constexpr int side = BedGeometry::tile_side;

/// Calls body(row, column of a vector) for the groups that groups_in(row) flags.
template <class Groups, class Body>
HWY_INLINE void for_groups(RowSpan rows, const Groups& groups_in, const Body& body) {
  for (int row = rows.begin; row < rows.end; ++row) for_vectors(groups_in(row), [&](int c) { body(row, c); });
}

FlowSize KeepFirstFlow(const TileFlow& flow, FirstFlow& first) {
  V peak = hn::Zero(d);
  LaneSum square;
  first.moved = {};
  first.rows = flow.rows;
  for (int row = flow.rows.begin; row < flow.rows.end; ++row)
    first.moved[row] = static_cast<std::uint8_t>(groups_of(flow.moved[row]));
  for_groups(
      flow.rows, [&](int row) { return first.moved[row]; },
      [&](int row, int c) {
        const V gain = hn::Load(d, flow.gain.data() + row * side + c);
        peak = Max(peak, hn::Abs(gain));
        square.add(c, gain * gain);
        hn::Store(gain, d, first.gain.data() + row * side + c);
      });
  return {largest(peak), square.total()};
}

HeightRange RangeOf(const double* heights, int rows, int cols) {
  Range range;
  for (int row = 0; row < rows; ++row)
    for (int c = 0; c < cols; c += lanes)
      range.add(hn::LoadU(d, heights + row * side + c), hn::FirstN(d, static_cast<std::size_t>(cols - c)));
  return range.over_lanes();
}

HeightRange SuperStage(const TileFlow& flow, const CellFlags& active, double momentum, double step,
                       TilePatch& patch, SuperStepTile& tile, CellFlags& changed) {
  Range range;
  for (int row = flow.rows.begin; row < flow.rows.end; ++row) {
    const unsigned wanted = groups_of(active[row]), moved = groups_of(flow.moved[row]);
    std::uint64_t flags = 0;
    for (unsigned left = wanted; left; left &= left - 1) {
      const int g = std::countr_zero(left);
      const bool moves = moved >> g & 1, stepped = tile.stepped[row] >> g & 1;
      for (int c = g * group; c < (g + 1) * group; c += lanes) {
        double *cells = patch.heights(row) + c, *before = tile.before->row(row) + c;
        const V now = hn::Load(d, cells);
        V next = with_momentum(now, stepped, all(momentum), before);
        if (moves) next += all(step) * hn::Load(d, flow.gain.data() + row * side + c);
        hn::Store(now, d, before);
        hn::Store(next, d, cells);
        range.add(next, lanes_of(active[row] >> c));
        flags |= static_cast<std::uint64_t>(bits(next != now)) << c;
      }
    }
    changed[row] = flags & active[row];  // a wall (NaN) beside them always compares as changed
    tile.stepped[row] |= static_cast<std::uint8_t>(wanted);
    tile.same[row] &= static_cast<std::uint8_t>(~wanted);
  }
  tile.rows = joined(tile.rows, flow.rows);
  return range.over_lanes();
}

void TakeBackStage(const SuperStepTile& tile, TilePatch& patch) {
  for_groups(
      tile.rows, [&](int row) { return tile.stepped[row]; },
      [&](int row, int c) { hn::Store(hn::Load(d, tile.before->row(row) + c), d, patch.heights(row) + c); });
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sandstroke {

HWY_EXPORT(KeepFirstFlow);
HWY_EXPORT(RangeOf);
HWY_EXPORT(SuperStage);
HWY_EXPORT(TakeBackStage);

FlowSize keep_first_flow(const TileFlow& flow, FirstFlow& first) {
  return HWY_DYNAMIC_DISPATCH(KeepFirstFlow)(flow, first);
}
HeightRange range_of(const double* heights, int rows, int cols) {
  return HWY_DYNAMIC_DISPATCH(RangeOf)(heights, rows, cols);
}
HeightRange super_stage(const TileFlow& flow, const CellFlags& active, double momentum, double step,
                        TilePatch& patch, SuperStepTile& tile, CellFlags& changed) {
  return HWY_DYNAMIC_DISPATCH(SuperStage)(flow, active, momentum, step, patch, tile, changed);
}
void take_back_stage(const SuperStepTile& tile, TilePatch& patch) {
  HWY_DYNAMIC_DISPATCH(TakeBackStage)(tile, patch);
}

}  // namespace sandstroke
#endif
