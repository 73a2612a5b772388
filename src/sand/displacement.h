#pragma once

#include <Eigen/Core>

#include "rules/displacement.h"
#include "sand/tool_footprint.h"

namespace sandstroke {

/// The paper's two passes (3.1): takes the sand that stands above the tool's underside out of the bowl, and
/// heaps it on the ring in proportion to the positive filter, or puts it outward. A second time there is
/// nothing to take out. The footprint must have been placed on the bed as it is now; it is used up. motion
/// [m]: the tool's displacement during the tick (Deposit::ahead). Returns the volume moved [m^3]; it is
/// conserved to rounding. Where no ring cell lies inside the bed nothing is displaced.
double displace(HeightField& bed, ToolFootprint& footprint, double tip_height, const Eigen::Vector3d& motion,
                const DisplacementSettings& settings);

/// A rule of your own in place of displace().
class Displacer {
 public:
  virtual ~Displacer() = default;
  /// The tool went by `motion` [m] to where the footprint lies, its tip at tip_height [m]. Takes the sand out
  /// of its way and puts it elsewhere (HeightField::set); returns the volume moved [m^3]. Sand is neither
  /// made nor lost, and none is put beyond the bed's wall (BedGeometry::sand_cols). The footprint's heights()
  /// are the bed's; its underside() and takes() are filled.
  virtual double displace(HeightField& bed, const ToolFootprint& footprint, double tip_height,
                          const Eigen::Vector3d& motion) = 0;
};

}  // namespace sandstroke
