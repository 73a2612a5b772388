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
  const V u2 = hn::Mul(u, u);
  V sum = hn::Set(d, terms[0]);
  for (int i = 1; i < 8; ++i) sum = hn::Add(hn::Mul(sum, u2), hn::Set(d, terms[i]));
  return hn::Add(u, hn::Mul(u, hn::Mul(u2, sum)));
}

/// Where the cells of a window lie relative to the tool's axis [m]; infinitely far beyond its last column.
class Offsets {
 public:
  explicit Offsets(const ToolFootprint& f)
      : dx_(f.cell_size()),
        cols_(f.cells().cols()),
        first_x_(f.first_x()),
        first_y_(f.first_y()),
        axis_x_(f.axis_x()),
        axis_y_(f.axis_y()) {}
  HWY_INLINE V x(int col) const {
    const V index = hn::Iota(d, col);
    const V x = hn::Mul(hn::Sub(hn::Iota(d, first_x_ + col), hn::Set(d, axis_x_)), hn::Set(d, dx_));
    return hn::IfThenElse(hn::Lt(index, hn::Set(d, cols_)), x,
                          hn::Set(d, std::numeric_limits<double>::infinity()));
  }
  double y(int row) const { return (first_y_ + row - axis_y_) * dx_; }

 private:
  double dx_;
  int cols_;
  double first_x_, first_y_, axis_x_, axis_y_;
};

double ShapeFootprint(const FootprintShape& shape, ToolFootprint& f) {
  const double dx = f.cell_size();
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0),
          infinite = hn::Set(d, std::numeric_limits<double>::infinity());
  const V reach = hn::Set(d, shape.reach), cell = hn::Set(d, dx), scale2 = hn::Set(d, shape.filter_scale2);
  const V radius = hn::Set(d, shape.radius), radius2 = hn::Set(d, shape.radius * shape.radius);
  const V far2 = hn::Set(d, (shape.reach + dx) * (shape.reach + dx) * (1.0 + 1e-14));
  const V u0 = hn::Set(d, filter::u0), u1 = hn::Set(d, filter::u1);
  const bool sphere = shape.profile == ToolProfile::sphere;
  const Offsets offsets(f);
  LaneSum heights, weights;
  for (int row = 0; row < f.cells().rows(); ++row) {
    const V y = hn::Set(d, offsets.y(row)), y2 = hn::Mul(y, y);
    for (int col = 0; col < f.stride(); col += lanes) {
      const V x = offsets.x(col), rho2 = hn::Add(hn::Mul(x, x), y2);
      double* underside = f.underside(row) + col;
      double* rampart = f.rampart(row) + col;
      if (hn::AllFalse(d, hn::Le(rho2, far2))) {
        hn::Store(infinite, d, underside);
        hn::Store(zero, d, rampart);
        continue;
      }
      const V fade = hn::Add(hn::Div(hn::Sub(reach, hn::Sqrt(rho2)), cell), one);
      const V weight = hn::Min(hn::Max(fade, zero), one);
      heights.add(col, hn::Mul(weight, hn::Load(d, f.heights(row) + col)));
      weights.add(col, weight);

      const V u = hn::Div(rho2, scale2), sine_u = sine(u);
      const auto in_bowl = hn::Le(u, u0);
      const auto in_ring = hn::And(hn::Gt(u, u0), hn::Le(u, u1));
      // The root's argument may fall below 0 by rounding at the rim.
      const V bowl = sphere ? hn::Sub(radius, hn::Sqrt(hn::Max(hn::Sub(radius2, rho2), zero)))
                            : hn::Mul(hn::Set(d, shape.amplitude), sine_u);
      hn::Store(hn::IfThenElse(in_bowl, bowl, infinite), d, underside);
      const V ring = hn::Max(hn::Sub(sine_u, hn::Set(d, filter::offset)), zero);
      hn::Store(hn::IfThenElseZero(in_ring, ring), d, rampart);
    }
  }
  const double weight = weights.total();
  return weight > 0.0 ? heights.total() / weight : std::numeric_limits<double>::quiet_NaN();
}

HWY_INLINE void set_flags(unsigned char* flags, int col, Mask mask) {
  flags[col / group] = static_cast<unsigned char>(flags[col / group] | bits(mask) << (col % group));
}

Carved Carve(ToolFootprint& f, double tip_height, const RingFront& front) {
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0), half = hn::Set(d, 0.5), tip = hn::Set(d, tip_height);
  const V cell = hn::Set(d, f.cell_size()), drag = hn::Set(d, front.drag_share);
  const Offsets offsets(f);
  LaneSum pushed, front_weight, ring_weight;
  for (int row = 0; row < f.cells().rows(); ++row) {
    const V ahead_y = hn::Set(d, offsets.y(row) * front.direction.y());
    unsigned char* flags = f.flags(row);
    std::fill_n(flags, f.stride() / group, static_cast<unsigned char>(0));
    for (int col = 0; col < f.stride(); col += lanes) {
      const V height = hn::Load(d, f.heights(row) + col);
      const V excess = hn::Max(hn::Sub(height, hn::Add(tip, hn::Load(d, f.underside(row) + col))), zero);
      const auto cut = hn::Gt(excess, zero);
      if (!hn::AllFalse(d, cut)) {
        hn::Store(hn::Sub(height, excess), d, f.heights(row) + col);
        hn::Store(excess, d, f.excess(row) + col);
        pushed.add(col, excess);
        set_flags(flags, col, cut);
      }
      const V rampart = hn::Load(d, f.rampart(row) + col);
      V weight = rampart;
      if (front.drag_share > 0.0 && !hn::AllFalse(d, hn::Gt(rampart, zero))) {
        const V ahead = hn::Add(hn::Mul(offsets.x(col), hn::Set(d, front.direction.x())), ahead_y);
        const V share = hn::Min(hn::Max(hn::Add(hn::Div(ahead, cell), half), zero), one);
        const V kept = hn::Mul(rampart, hn::Sub(one, hn::Mul(drag, hn::Sub(one, share))));
        weight =
            hn::IfThenElseZero(hn::Gt(rampart, zero), kept);  // beyond the last column, offsets are infinite
      }
      hn::Store(weight, d, f.weights(row) + col);
      front_weight.add(col, weight);
      ring_weight.add(col, rampart);
    }
  }
  return {pushed.total(), front_weight.total(), ring_weight.total()};
}

void Heap(ToolFootprint& f, double rise, bool whole_ring) {
  const V rise_of_one = hn::Set(d, rise);
  for (int row = 0; row < f.cells().rows(); ++row) {
    const double* weights = whole_ring ? f.rampart(row) : f.weights(row);
    for (int col = 0; col < f.stride(); col += lanes) {
      const V weight = hn::Load(d, weights + col);
      const auto heaped = hn::Gt(weight, hn::Zero(d));
      if (hn::AllFalse(d, heaped)) continue;
      double* height = f.heights(row) + col;
      hn::Store(hn::Add(hn::Load(d, height), hn::Mul(rise_of_one, weight)), d, height);
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
