#pragma once

#include <Eigen/Core>

#include "sand/height_field.h"

namespace sandstroke {

/// The plane of the sand around a tool: z [m] = height + slope . (position - axis). NaN: there is no sand.
struct SandPlane {
  double height;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};

/// Fits a plane to the sand on three circles around (x, y) [m], at 1.5, 2 and 2.5 times `reach` [m]. They lie
/// outside the tool, its furrow and most of the sand that it has deposited. Sand there that does not fit the
/// rest (the furrow behind) counts for little: the fit has least absolute deviations, by four rounds of
/// weighted least squares.
SandPlane fit_sand_plane(const HeightField& bed, double x, double y, double reach);

}  // namespace sandstroke
