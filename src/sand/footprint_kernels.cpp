#include "sand/footprint_kernels.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/footprint_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

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

/// Between 0 and 1.
HWY_INLINE V clamped(V x) { return Min(Max(x, hn::Zero(d)), all(1.0)); }

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
    const V x = (hn::Iota(d, first_x_ + col) - all(axis_x_)) * all(dx_), at = hn::Iota(d, col);
    const Mask has_sand = hn::And(at >= all(sand.begin), at < all(sand.end));
    return hn::IfThenElse(has_sand, x, all(std::numeric_limits<double>::infinity()));
  }
  double y(int row) const { return (first_y_ + row - axis_y_) * dx_; }

 private:
  double dx_;
  double first_x_, first_y_, axis_x_, axis_y_;
};

double ShapeFootprint(const FootprintShape& shape, ToolFootprint& f) {
  const double dx = f.cell_size();
  const V zero = hn::Zero(d), one = all(1.0), infinite = all(std::numeric_limits<double>::infinity());
  const V rho1 = all(shape.reach), cell = all(dx), s2 = all(shape.filter_scale2), a = all(shape.amplitude);
  const V R = all(shape.radius), R2 = all(shape.radius * shape.radius);
  const V far2 = all((shape.reach + dx) * (shape.reach + dx) * (1.0 + 1e-14));
  const V u0 = all(filter::u0), u1 = all(filter::u1), offset = all(filter::offset);
  const bool sphere = shape.profile == ToolProfile::sphere;
  const Offsets offsets(f);
  LaneSum heights, weights;
  for (int row = 0; row < f.cells().rows(); ++row) {
    const V y = all(offsets.y(row)), y2 = y * y;
    const ColumnRange sand = f.sand_cols(row);
    for (int col = 0; col < f.stride(); col += lanes) {
      const V x = offsets.x(sand, col), rho2 = x * x + y2;
      double* underside = f.underside(row) + col;
      double* rampart = f.rampart(row) + col;
      if (hn::AllFalse(d, rho2 <= far2)) {
        hn::Store(infinite, d, underside);
        hn::Store(zero, d, rampart);
        continue;
      }
      const V weight = clamped((rho1 - Sqrt(rho2)) / cell + one);
      heights.add(col, weight * hn::Load(d, f.heights(row) + col));
      weights.add(col, weight);

      const V u = rho2 / s2, sin_u = sine(u);
      // The root's argument may fall below 0 by rounding at the rim.
      const V bowl = sphere ? R - Sqrt(Max(R2 - rho2, zero)) : a * sin_u;
      hn::Store(hn::IfThenElse(u <= u0, bowl, infinite), d, underside);
      hn::Store(where(hn::And(u > u0, u <= u1), Max(sin_u - offset, zero)), d, rampart);
    }
  }
  const double weight = weights.total();
  return weight > 0.0 ? heights.total() / weight : std::numeric_limits<double>::quiet_NaN();
}

HWY_INLINE void set_flags(unsigned char* flags, int col, Mask mask) {
  flags[col / group] = static_cast<unsigned char>(flags[col / group] | bits(mask) << (col % group));
}

Carved Carve(ToolFootprint& f, double tip_height, const RingFront& front) {
  const V zero = hn::Zero(d), one = all(1.0), half = all(0.5), tip = all(tip_height);
  const V cell = all(f.cell_size()), drag = all(front.drag_share);
  const Offsets offsets(f);
  LaneSum pushed, front_weight, ring_weight;
  for (int row = 0; row < f.cells().rows(); ++row) {
    const V ahead_y = all(offsets.y(row) * front.direction.y());
    const ColumnRange sand = f.sand_cols(row);
    unsigned char* flags = f.flags(row);
    std::fill_n(flags, f.stride() / group, static_cast<unsigned char>(0));
    for (int col = 0; col < f.stride(); col += lanes) {
      const V height = hn::Load(d, f.heights(row) + col);
      const V excess = Max(height - (tip + hn::Load(d, f.underside(row) + col)), zero);
      const Mask cut = excess > zero;
      if (!hn::AllFalse(d, cut)) {
        hn::Store(height - excess, d, f.heights(row) + col);
        hn::Store(excess, d, f.excess(row) + col);
        pushed.add(col, excess);
        set_flags(flags, col, cut);
      }
      const V rampart = hn::Load(d, f.rampart(row) + col);
      V weight = rampart;
      const Mask in_ring = rampart > zero;  // elsewhere offsets may be infinite
      if (front.drag_share > 0.0 && !hn::AllFalse(d, in_ring)) {
        const V p = offsets.x(sand, col) * all(front.direction.x()) + ahead_y;
        weight = where(in_ring, rampart * (one - drag * (one - clamped(p / cell + half))));
      }
      hn::Store(weight, d, f.weights(row) + col);
      front_weight.add(col, weight);
      ring_weight.add(col, rampart);
    }
  }
  return {pushed.total(), front_weight.total(), ring_weight.total()};
}

void Heap(ToolFootprint& f, double rise, bool whole_ring) {
  for (int row = 0; row < f.cells().rows(); ++row) {
    const double* weights = whole_ring ? f.rampart(row) : f.weights(row);
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

HWY_EXPORT(ShapeFootprint);
HWY_EXPORT(Carve);
HWY_EXPORT(Heap);

double shape_footprint(const FootprintShape& shape, ToolFootprint& footprint) {
  return HWY_DYNAMIC_DISPATCH(ShapeFootprint)(shape, footprint);
}
Carved carve(ToolFootprint& footprint, double tip_height, const RingFront& front) {
  return HWY_DYNAMIC_DISPATCH(Carve)(footprint, tip_height, front);
}
void heap(ToolFootprint& footprint, double rise, bool whole_ring) {
  HWY_DYNAMIC_DISPATCH(Heap)(footprint, rise, whole_ring);
}

}  // namespace sandstroke
#endif
