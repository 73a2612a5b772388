#pragma once

#include <Eigen/Core>

#include "sand/height_field.h"

namespace sandstroke {

/// z [m] = height + slope . (place - axis): how the sand lies around a tool. Not a number: there is none.
struct SandPlane {
  double height;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};

/// A plane through the sand on three circles around (x, y) [m], at 1.5, 2 and 2.5 times `reach` [m]: beside
/// the tool, its furrow and most of what it has heaped up. What does not fit the others there (the furrow
/// behind) counts for little: least absolute deviations, by four turns of weighted least squares.
SandPlane fit_sand_plane(const HeightField& bed, double x, double y, double reach);

}  // namespace sandstroke
