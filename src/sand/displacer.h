#pragma once

#include <Eigen/Core>

#include "sand/tool.h"

namespace sandstroke {

/// Base of a displacement rule of your own, which replaces Tool::displace().
class Displacer {
 public:
  virtual ~Displacer() = default;
  /// A copy with all that it knows, for copies of a simulation; none: it cannot be copied.
  virtual std::unique_ptr<Displacer> copy() const { return nullptr; }
  /// The tool has moved by `motion` [m] to where its footprint lies, and its tip is at tip_height [m]. Takes
  /// the sand out of the tool's way and puts it elsewhere (HeightField::set). Returns the volume moved [m^3].
  /// It must not make or lose sand, nor put any beyond the bed's wall (BedGeometry::sand_cols). The
  /// footprint's heights() are the bed's; its underside() and takes() are filled.
  virtual double displace(HeightField& bed, const Tool& tool, double tip_height,
                          const Eigen::Vector3d& motion) = 0;
};

}  // namespace sandstroke
