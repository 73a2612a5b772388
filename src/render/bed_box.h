#pragma once

#include <Eigen/Geometry>

#include "render/gl_objects.h"
#include "render/horizon.h"

namespace sandstroke {

/// The box that holds the sand: a wall around the bed whose rim follows the crest of the sand along the
/// border.
class BedBox {
 public:
  BedBox();
  /// Rebuilds the wall around a surface.
  void update(const BedGeometry& bed, const DrawnHeights& heights, double lowest);
  void draw() const;
  /// All of the wall and the ground it stands on, [m].
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  double wall_thickness() const { return wall_thickness_; }  ///< m

 private:
  GlObject layout_, vertices_;
  int vertex_count_ = 0;
  Eigen::AlignedBox3d bounds_;
  double wall_thickness_ = 0.0;
};

}  // namespace sandstroke
