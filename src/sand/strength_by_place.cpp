#include "sand/strength_by_place.h"

#include <algorithm>

namespace sandstroke {
namespace {

/// resistance() per density over the own sand's: 1 to the bit for the same friction.
double factor_of(double friction_angle, const SandStrength& own) {
  return resistance({.friction_angle = friction_angle, .density = 1.0}) /
         resistance({.friction_angle = own.friction_angle, .density = 1.0});
}

}  // namespace

StrengthByPlace::StrengthByPlace(const GroundSettings& ground, const SandStrength& own, double blend)
    : densities_(
          ground.regions,
          [&](const SandRegion& region) -> std::optional<double> {
            if (!region.density) return {};
            return *region.density / own.density;
          },
          blend),
      factors_(
          ground.regions,
          [&](const SandRegion& region) -> std::optional<double> {
            if (!region.friction_angle) return {};
            return factor_of(*region.friction_angle, own);
          },
          blend),
      blend_(blend) {
  for (const SandLayer& layer : ground.layers)
    layers_.push_back({layer.top, layer.density.value_or(own.density) / own.density,
                       factor_of(layer.friction_angle.value_or(own.friction_angle), own)});
  std::sort(layers_.begin(), layers_.end(),
            [](const ColumnLayer& a, const ColumnLayer& b) { return a.top > b.top; });
}

void StrengthByPlace::look(const ToolElements& elements, const Eigen::Vector3d& tip) {
  density_.resize(elements.size());
  factor_.resize(elements.size());
  densities_.fill(elements, tip.head<2>(), 1.0, density_.data());
  factors_.fill(elements, tip.head<2>(), 1.0, factor_.data());
}

}  // namespace sandstroke
