#pragma once

#include <Eigen/Core>

#include "sand/height_field.h"

namespace sandstroke {

/// Heights as they are drawn, [m], row-major: single precision resolves 1e-7 of the height.
using DrawnHeights = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The sun's position in the sky, and how wide its penumbra is.
struct Sun {
  double azimuth = 145.0;   ///< deg, from +x towards +y
  double elevation = 28.0;  ///< deg, > 0
  double softness = 1.5;    ///< deg, half of the elevation range over which sand goes from light to shadow
  bool operator==(const Sun&) const = default;
  Eigen::Vector3d direction() const;  ///< unit vector towards the sun
};

/// How far [cells] a height difference of `relief` [m] can throw a shadow.
int shadow_reach(const Sun& sun, double relief, double cell_size);

/// The part of the sun seen from each of `cells`, 0 to 1, written to the same cells of `visible`. It is 1/2
/// where the horizon towards the sun stands as high as the sun. The search for the horizon goes one cell at a
/// time along the main axis, linear between cells across it. Nothing outside the bed throws a shadow. highest
/// [m]: of all cells.
void sun_visibility(const DrawnHeights& heights, double cell_size, const Sun& sun, double highest,
                    const CellRange& cells, DrawnHeights& visible);

/// The part of the sky seen from each of `cells`, 0 to 1 (1 on a plane or a crest): the mean over 8
/// directions of 1 - sin(horizon). The search for the horizon goes up to sky_reach cells.
void sky_visibility(const DrawnHeights& heights, double cell_size, const CellRange& cells,
                    DrawnHeights& visible);
inline constexpr int sky_reach = 18;  ///< cells

}  // namespace sandstroke
