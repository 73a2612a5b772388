// sand_pressure() of src/rules/layers.h on vectors, with the same bits. Included once per instruction set
// (Highway's convention for -inl.h files).
#if defined(SANDSTROKE_SAND_PRESSURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SANDSTROKE_SAND_PRESSURE_INL_H_
#undef SANDSTROKE_SAND_PRESSURE_INL_H_
#else
#define SANDSTROKE_SAND_PRESSURE_INL_H_
#endif

#include "sand/lanes-inl.h"
#include "sand/strength_by_place.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

struct PressureLanes {
  V depth, growth, change;
};

/// places: null where sand is the same everywhere. i: of the first element. z [m]: of the elements. depth
/// [m]: below the surface, 0 or more.
HWY_INLINE PressureLanes pressure_at(const StrengthByPlace* places, std::size_t i, V z, V depth) {
  const V zero = hn::Zero(d), one = all(1.0);
  if (!places) return {depth, one, zero};
  const V per_blend = all(1.0 / places->blend());
  V upper_density = hn::Load(d, places->density() + i), upper_factor = hn::Load(d, places->factor() + i);
  V density = upper_density, weight = upper_density * depth, factor = upper_factor, change = zero;
  for (const ColumnLayer& layer : places->layers()) {
    const V layer_density = all(layer.density), layer_factor = all(layer.factor);
    const V below = all(layer.top) - z, share = below * per_blend + all(0.5),
            step = layer_factor - upper_factor;
    weight += (layer_density - upper_density) * Min(Max(below, zero), depth);
    factor += step * Min(Max(share, zero), one);
    density = hn::IfThenElse(below > zero, layer_density, density);
    change += where(hn::And(share > zero, share < one), step * per_blend);
    upper_density = layer_density;
    upper_factor = layer_factor;
  }
  return {factor * weight, factor * density, change * weight};
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#endif
