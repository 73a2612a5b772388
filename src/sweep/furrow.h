#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// Where the tip went while it was in contact [m], in order. A piece begins at each point whose index is in
/// `pieces` (ascending, the first 0): before it the tool was lifted.
struct TipPath {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::size_t> pieces;
};

/// What a stroke left of itself, in cross-sections of the change of height (final - initial), so that the
/// shape the bed had before does not count. Not-a-number: nothing to measure.
struct FurrowMeasures {
  /// m, how far below the surface as it was the lowest point lies, of those within a tool radius of the path;
  /// 0 where there is no furrow.
  double depth = std::numeric_limits<double>::quiet_NaN();
  /// m, between the points left and right of the lowest one where the change comes back to zero.
  double width = std::numeric_limits<double>::quiet_NaN();
  /// m, highest point, of either side, of the first sand outwards from there that was raised (and what joins
  /// it).
  double rampart = std::numeric_limits<double>::quiet_NaN();
};

/// The median over sections across the direction of travel, a tool radius [m] apart (further, where that
/// would be more than 1000), so that ends, crossings and neighbouring strokes do not count as long as they
/// are the smaller part. A contact that stays within half a radius is one section across x. Sections reach 6
/// radii to either side and are taken at every half cell, linear between centres of cells. A width whose ends
/// are not both inside that and the bed is left out. Both fields of one shape; only what the sections pass is
/// looked at. The error is of the order of slope x cell size.
FurrowMeasures measure_furrow(const HeightField& initial, const HeightField& final, const TipPath& path,
                              double tool_radius);

}  // namespace sandstroke
