#include "sand/super_step_kernels.h"

#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/super_step_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sand/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

constexpr int side = BedGeometry::tile_side;

/// Calls body(row, group) for the groups that groups_in(row) flags.
template <class Groups, class Body>
HWY_INLINE void for_groups(const Groups& groups_in, const Body& body) {
  for (int row = 0; row < side; ++row)
    for (unsigned wanted = groups_in(row); wanted; wanted &= wanted - 1) body(row, std::countr_zero(wanted));
}

FlowSize KeepFirstFlow(const TileFlow& flow, SuperStepTile& tile) {
  V peak = hn::Zero(d);
  LaneSum square;
  for (int row = 0; row < side; ++row)
    tile.first_moved[row] = static_cast<std::uint8_t>(groups_of(flow.moved[row]));
  for_groups([&](int row) { return tile.first_moved[row]; },
             [&](int row, int g) {
               for (int c = g * group; c < (g + 1) * group; c += lanes) {
                 const V gain = hn::Load(d, flow.gain.data() + row * side + c);
                 peak = Max(peak, hn::Abs(gain));
                 square.add(c, gain * gain);
                 hn::Store(gain, d, tile.first_gain.data() + row * side + c);
               }
             });
  return {largest(peak), square.total()};
}

FlowChange CompareFlows(const TileFlow& flow, const SuperStepTile& tile) {
  V difference = hn::Zero(d);
  LaneSum product;
  for_groups([&](int row) { return groups_of(flow.moved[row]) | tile.first_moved[row]; },
             [&](int row, int g) {
               const bool now = groups_of(flow.moved[row]) >> g & 1, first = tile.first_moved[row] >> g & 1;
               for (int c = g * group; c < (g + 1) * group; c += lanes) {
                 const int at = row * side + c;
                 const V gain = now ? hn::Load(d, flow.gain.data() + at) : hn::Zero(d);
                 const V before = first ? hn::Load(d, tile.first_gain.data() + at) : hn::Zero(d);
                 difference = Max(difference, hn::Abs(gain - before));
                 product.add(c, gain * before);
               }
             });
  return {largest(difference), product.total()};
}

/// Lowest and highest, lane by lane.
struct Range {
  V low, high;
  HWY_INLINE Range() : low(all(std::numeric_limits<double>::infinity())), high(hn::Neg(low)) {}
  HWY_INLINE void add(V heights, Mask counts) {
    low = hn::IfThenElse(counts, Min(low, heights), low);
    high = hn::IfThenElse(counts, Max(high, heights), high);
  }
  HWY_INLINE HeightRange over_lanes() const { return {least(low), largest(high)}; }
};

HeightRange RangeOf(const double* heights, int rows, int cols) {
  Range range;
  for (int row = 0; row < rows; ++row)
    for (int c = 0; c < cols; c += lanes)
      range.add(hn::Load(d, heights + row * side + c), hn::FirstN(d, static_cast<std::size_t>(cols - c)));
  return range.over_lanes();
}

HeightRange SuperStage(const TileFlow& flow, const CellFlags& active, double momentum, double step,
                       double* heights, SuperStepTile& tile, CellFlags& changed) {
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
                   next += all(momentum) * (now - before);
                 }
                 if (moved) next += all(step) * hn::Load(d, flow.gain.data() + at);
                 hn::Store(now, d, tile.before.data() + at);
                 hn::Store(next, d, heights + at);
                 range.add(next, lanes_of(active[row] >> c));
                 changed[row] |= static_cast<std::uint64_t>(bits(next != now)) << c;
               }
             });
  for (int row = 0; row < side; ++row) tile.stepped[row] |= static_cast<std::uint8_t>(groups_of(active[row]));
  return range.over_lanes();
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

HWY_EXPORT(KeepFirstFlow);
HWY_EXPORT(CompareFlows);
HWY_EXPORT(RangeOf);
HWY_EXPORT(SuperStage);
HWY_EXPORT(TakeBackStage);

FlowSize keep_first_flow(const TileFlow& flow, SuperStepTile& tile) {
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
void take_back_stage(const SuperStepTile& tile, double* heights) {
  HWY_DYNAMIC_DISPATCH(TakeBackStage)(tile, heights);
}

}  // namespace sandstroke
#endif
