#pragma once

#include <Eigen/Core>

#include "rules/displacement.h"
#include "sand/tool_footprint.h"

namespace sandstroke {

/// Makes the paper's two passes (3.1). The first carves the sand above the tool's underside out of the bowl.
/// The second deposits it on the ring in proportion to the positive filter, or outward. A second call carves
/// nothing more. The footprint must have been placed on the bed as it is now; it is used up. motion [m]: the
/// tool's displacement during the tick (Deposit::ahead). Returns the volume moved [m^3]; volume is conserved
/// to rounding. If no ring cell lies inside the bed, nothing is displaced.
double displace(HeightField& bed, ToolFootprint& footprint, double tip_height, const Eigen::Vector3d& motion,
                const DisplacementSettings& settings);

/// Base of a displacement rule of your own, which replaces displace().
class Displacer {
 public:
  virtual ~Displacer() = default;
  /// The tool has moved by `motion` [m] to where the footprint lies, and its tip is at tip_height [m]. Takes
  /// the sand out of the tool's way and puts it elsewhere (HeightField::set). Returns the volume moved [m^3].
  /// It must not make or lose sand, nor put any beyond the bed's wall (BedGeometry::sand_cols). The
  /// footprint's heights() are the bed's; its underside() and takes() are filled.
  virtual double displace(HeightField& bed, const ToolFootprint& footprint, double tip_height,
                          const Eigen::Vector3d& motion) = 0;
};

}  // namespace sandstroke
