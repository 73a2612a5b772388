// Code for both ways to take a stage of a super-step. Included once per instruction set, like lanes-inl.h.
#if defined(SANDSTROKE_SAND_STAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SANDSTROKE_SAND_STAGE_INL_H_
#undef SANDSTROKE_SAND_STAGE_INL_H_
#else
#define SANDSTROKE_SAND_STAGE_INL_H_
#endif

#include <limits>

#include "sand/lanes-inl.h"
#include "sand/super_step_tile.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

/// The lowest and highest height, per lane.
struct Range {
  V low, high;
  HWY_INLINE Range() : low(all(std::numeric_limits<double>::infinity())), high(hn::Neg(low)) {}
  HWY_INLINE void add(V heights, Mask counts) {
    low = hn::IfThenElse(counts, Min(low, heights), low);
    high = hn::IfThenElse(counts, Max(high, heights), high);
  }
  HWY_INLINE HeightRange over_lanes() const { return {least(low), largest(high)}; }
};

/// Y + momentum (Y - Z), or Y if there is no Z.
HWY_INLINE V with_momentum(V now, bool stepped, V momentum, const double* before) {
  return stepped ? now + momentum * (now - hn::Load(d, before)) : now;
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#endif
