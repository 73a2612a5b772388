// How steep cells are: their drops to the neighbours, and slopes from them. Included once per instruction
// set, like lanes-inl.h.
#if defined(SANDSTROKE_SAND_SLOPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SANDSTROKE_SAND_SLOPES_INL_H_
#undef SANDSTROKE_SAND_SLOPES_INL_H_
#else
#define SANDSTROKE_SAND_SLOPES_INL_H_
#endif

#include "sand/lanes-inl.h"
#include "sand/tile_patch.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

/// The lower of both; a wall (NaN) as `a` is ignored.
HWY_INLINE V lower(V a, V b) {
#if HWY_ARCH_X86
  return hn::Min(a, b);  // min*pd: the second operand where one is NaN
#else
  return hn::IfThenElse(a < b, a, b);
#endif
}

/// The heights, or the factors, of `lanes` cells from column `c`, and of their axis neighbours.
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
HWY_INLINE V axis_drop(const Around& a) { return a.m - lower(a.w, lower(a.e, lower(a.n, lower(a.s, a.m)))); }
HWY_INLINE V diagonal_drop(V m, const Corners& k) {
  return m - lower(k.nw, lower(k.se, lower(k.ne, lower(k.sw, m))));
}
HWY_INLINE V squared_slope(const Around& a) {
  const V gx = a.m - lower(a.w, lower(a.e, a.m)), gy = a.m - lower(a.n, lower(a.s, a.m));
  return gx * gx + gy * gy;
}

/// Flow from a cell to one neighbour (out) and back (in, negative); at most one of them is not 0.
struct Exchange {
  V out, in;
};
HWY_INLINE Exchange exchange(V m, V factor, V neighbour, V neighbour_factor, V threshold, V negative) {
  const V drop = m - neighbour;
  return {where(drop > threshold, factor * drop), where(drop < negative, neighbour_factor * drop)};
}
HWY_INLINE Exchange operator+(const Exchange& a, const Exchange& b) { return {a.out + b.out, a.in + b.in}; }

/// What flows through the faces of the cells in a vector: to the east and to the south it counts as positive.
struct CellFaces {
  V east, west, south, north;

  /// The cells' entries where each cell has the flow through its eastern (right) and southern face (below),
  /// in the layout of a patch.
  HWY_INLINE CellFaces(const double* right, const double* below)
      : east(hn::LoadU(d, right)),
        west(hn::LoadU(d, right - 1)),
        south(hn::LoadU(d, below)),
        north(hn::LoadU(d, below - TilePatch::stride)) {}

  /// What the cells give through all faces, and what they gain by all.
  HWY_INLINE V given() const {
    const V zero = hn::Zero(d);
    return (Max(zero, east) + Max(zero, hn::Neg(west))) + (Max(zero, south) + Max(zero, hn::Neg(north)));
  }
  HWY_INLINE V gained() const { return (west - east) + (north - south); }
};

/// What flows from a cell to a neighbour this much lower, or back (negative), with the factors of both.
HWY_INLINE V exchanged(V drop, V factor, V neighbour_factor) {
  const V zero = hn::Zero(d);
  return where(drop > zero, factor * drop) + where(drop < zero, neighbour_factor * drop);
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#endif
