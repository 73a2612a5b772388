#pragma once

#include "core/aligned_vector.h"
#include "rules/layers.h"
#include "sand/region_values.h"
#include "sand/resistive_force.h"

namespace sandstroke {

/// How strong the sand around a tool is, where regions and layers give it friction and density of their own
/// (src/rules, rule 21). Borders are where the scene puts them: they do not move with the sand.
class StrengthByPlace {
 public:
  /// own: the scene's sand, of which this tells multiples. blend [m]: around a border, over which friction
  /// comes, so that a tool which goes through it meets no step.
  StrengthByPlace(const GroundSettings& ground, const SandStrength& own, double blend);

  /// Looks at the sand of each element, with the tool's tip at this place [m].
  void look(const ToolElements& elements, const Eigen::Vector3d& tip);

  /// Density and factor of each element's uppermost sand: of as many as the elements' size().
  const double* density() const { return density_.data(); }
  const double* factor() const { return factor_.data(); }
  const std::vector<ColumnLayer>& layers() const { return layers_; }  ///< the highest first
  double blend() const { return blend_; }                             ///< m

 private:
  std::vector<ColumnLayer> layers_;
  RegionValues densities_, factors_;
  double blend_;
  AlignedVector<double> density_, factor_;
};

}  // namespace sandstroke
