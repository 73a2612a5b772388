#pragma once

#include <Eigen/Geometry>

#include "picture/view.h"
#include "render/pixel_rect.h"

namespace sandstroke {

/// Position, direction and scale of a view. The picture's x and y run from -1 to 1 from its left and lower
/// border.
struct Camera {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();        ///< m
  Eigen::Vector3d forward = -Eigen::Vector3d::UnitZ();  ///< unit vector
  Eigen::Matrix4d to_clip = Eigen::Matrix4d::Identity();
  bool orthographic = false;
  double scale = 1.0;  ///< pixels per metre: at distance 1 m, or at any distance if orthographic

  /// The most pixels that 1 m takes where a box is seen.
  double pixels_per_metre(const Eigen::AlignedBox3d& box) const;
  /// True where no part of a box can be in the picture.
  bool misses(const Eigen::AlignedBox3d& box) const;
  /// All pixels of a picture of this size on which a box may be seen.
  PixelRect pixels_of(const Eigen::AlignedBox3d& box, int width, int height) const;
  /// A bound on how far [m] the point under a pixel moves, seen from above, from one pixel to the next, on a
  /// surface in a box. steepest: the surface's largest slope. Infinite where it may be seen edge-on.
  double widest_pixel(const Eigen::AlignedBox3d& box, double steepest) const;
};

/// The camera of a view. The views overview, stroke and top frame `subject`: they fit it into the picture
/// less right_margin (a part of its width, for a legend). `scene` is all that may be drawn (for the depth
/// range). A distance > 0 is kept; with 0 the subject just fits. custom looks at view.target; top is
/// orthographic with +y up. Error: input, where an angle or distance is out of range.
Camera make_camera(const ViewSettings& view, const Eigen::AlignedBox3d& subject,
                   const Eigen::AlignedBox3d& scene, double right_margin = 0.0);

}  // namespace sandstroke
