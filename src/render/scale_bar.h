#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "picture/image.h"
#include "render/camera.h"

namespace sandstroke {

/// A bar that shows a round length in a picture: its ends, and its label's lower left corner, in pixels from
/// the upper left corner.
struct ScaleBar {
  Eigen::Vector2d from, to, label_at;
  double length = 0.0;  ///< m
  std::string label;
};

/// The bar of a picture of this size: in its lower left corner where the camera is orthographic, otherwise on
/// the ground along the near side of the box. None where that is not in the picture.
std::optional<ScaleBar> scale_bar(const Camera& camera, const Eigen::AlignedBox3d& box, int width,
                                  int height);

/// Draws the bar with ticks at its ends, and its label.
void draw_scale_bar(Image& image, const ScaleBar& bar);

}  // namespace sandstroke
