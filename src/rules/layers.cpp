#include "rules/layers.h"

#include <algorithm>

namespace sandstroke {

SandPressure sand_pressure(const SandColumn& column, double z, double depth) {
  const double per_blend = 1.0 / column.blend;
  double upper_density = column.density, upper_factor = column.factor;  // of the sand above a layer
  double density = upper_density, weight = upper_density * depth, factor = upper_factor, change = 0.0;
  for (const ColumnLayer& layer : column.layers) {
    const double below = layer.top - z, share = below * per_blend + 0.5, step = layer.factor - upper_factor;
    weight += (layer.density - upper_density) * std::clamp(below, 0.0, depth);
    factor += step * std::clamp(share, 0.0, 1.0);
    if (below > 0.0) density = layer.density;
    if (share > 0.0 && share < 1.0) change += step * per_blend;
    upper_density = layer.density;
    upper_factor = layer.factor;
  }
  return {factor * weight, factor * density, change * weight};
}

}  // namespace sandstroke
