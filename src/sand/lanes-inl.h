// Vector helpers of all kernels here. They work on groups of 8 doubles, in as many vectors as that takes.
// Included once per instruction set (Highway's convention for -inl.h files).
#if defined(SANDSTROKE_SAND_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SANDSTROKE_SAND_LANES_INL_H_
#undef SANDSTROKE_SAND_LANES_INL_H_
#else
#define SANDSTROKE_SAND_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>

#include "sand/cell_flags.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int group = cells_per_group;
const hn::CappedTag<double, group> d;
using V = hn::Vec<decltype(d)>;
using Mask = hn::Mask<decltype(d)>;
constexpr int lanes = static_cast<int>(hn::MaxLanes(d));

// Formulas are written with the vectors' own operators, and these:
using hn::Max;
using hn::Min;
using hn::Sqrt;
HWY_INLINE V all(double x) { return hn::Set(d, x); }
/// x in the lanes of the mask, elsewhere 0.
HWY_INLINE V where(Mask mask, V x) { return hn::IfThenElseZero(mask, x); }

/// The lanes of a mask as flags, in the low bits.
HWY_INLINE unsigned bits(Mask mask) {
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0];
}
/// The lanes that the low bits flag.
HWY_INLINE Mask lanes_of(std::uint64_t flags) {
  const uint8_t bytes[8] = {static_cast<uint8_t>(flags & ((1u << lanes) - 1))};
  return hn::LoadMaskBits(d, bytes);
}

HWY_INLINE double largest(V v) { return hn::GetLane(hn::MaxOfLanes(d, v)); }
HWY_INLINE double least(V v) { return hn::GetLane(hn::MinOfLanes(d, v)); }

/// A sum whose bits do not depend on the vectors' width: one sum for each of a group's 8 numbers, added up at
/// the end.
class LaneSum {
 public:
  HWY_INLINE LaneSum() {
    for (V& sum : sums_) sum = hn::Zero(d);
  }
  /// index: of the vector's first lane.
  HWY_INLINE void add(int index, V terms) { sums_[index % group / lanes] += terms; }
  HWY_INLINE double total() const {
    alignas(64) double s[group];
    for (int i = 0; i < group; i += lanes) hn::Store(sums_[i / lanes], d, s + i);
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
  }

 private:
  V sums_[group / lanes];
};

/// Calls body(column of a vector's first lane) for the vectors of a row's flagged groups.
template <class Body>
HWY_INLINE void for_vectors(unsigned groups, const Body& body) {
  for (; groups; groups &= groups - 1) {
    const int begin = std::countr_zero(groups) * group;
    for (int c = begin; c < begin + group; c += lanes) body(c);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#endif
