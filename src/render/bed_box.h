#pragma once

#include <Eigen/Geometry>

#include "render/gl_objects.h"
#include "render/render_subject.h"

namespace sandstroke {

/// The box that holds the sand: a wall around the bed, with a level rim, on level ground. The box does not
/// follow the sand, which may come to lie above the rim and below the ground.
class BedBox {
 public:
  BedBox();
  /// Rebuilds the wall around a bed with these start heights.
  void update(const BedGeometry& bed, const StartHeights& start);
  void draw_wall() const;
  /// Draws only the ground's depth, no colours. The ground hides a pit that is deeper than the box.
  void draw_ground_depth() const;
  /// The wall above the ground [m].
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  double wall_thickness() const { return wall_thickness_; }  ///< m

 private:
  GlObject layout_, vertices_;
  int wall_vertices_ = 0, ground_vertices_ = 0;
  Eigen::AlignedBox3d bounds_;
  double wall_thickness_ = 0.0;
};

}  // namespace sandstroke
