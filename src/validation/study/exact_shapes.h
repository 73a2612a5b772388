#pragma once

#include <functional>

#include "haptics/force_model.h"
#include "sand/relaxation.h"

namespace sandstroke {

// What sand comes to rest as, and what a device's work is, in closed form.
// Heights and lengths in m, talus angles in deg. The shapes hold for the isotropic law; those that do not
// change along y or along x hold for both, and the crater comes in both laws' shapes.

/// Height at (x, y).
using ExactSurface = std::function<double(double x, double y)>;

/// A cone on a flat bed around the origin, cut off level at its plateau: the talus slope lies between the
/// radii `plateau` and `foot`.
struct ExactCone {
  double slope, plateau, foot;
  double top() const { return slope * (foot - plateau); }
  double operator()(double x, double y) const;
};
/// What a cylinder comes to: a full cone where height >= sqrt(3) radius tan(talus), else a truncated one.
ExactCone collapsed_cylinder(double radius, double height, double talus_angle);
/// What a cone steeper than the talus comes to: the talus cone of its volume.
ExactCone collapsed_cone(double radius, double height, double talus_angle);

/// What a cliff from `height` (x < 0) down to 0 comes to: a ramp centred on its edge.
struct ExactRamp {
  double slope, height;
  double operator()(double x, double y) const;
};
ExactRamp collapsed_cliff(double height, double talus_angle);

/// What a slot along y, 2 `half_width` wide and `depth` deep, fills to: a V, where that is shallower than the
/// slot and wider (depth > 2 tan(talus) half_width).
struct ExactTrench {
  double slope, half_width;
  double depth() const { return slope * half_width; }
  double operator()(double x, double y) const;
};
ExactTrench filled_slot(double half_width, double depth, double talus_angle);

/// What is left of a flat bed that drains through a hole at the origin until the hole is `depth` below:
/// a cone under the isotropic law, under the paper's an octagonal pyramid.
struct ExactCrater {
  RelaxationLaw law;
  double slope, depth;
  double operator()(double x, double y) const;
};
ExactCrater drained_crater(double depth, double talus_angle, RelaxationLaw law);

/// How far a path along axes and diagonals leads: the distance that the paper's law knows.
double octile_distance(double x, double y);

/// Work [J] of pushing the tip at constant speed into undisturbed sand, without drag.
double plunge_work(double depth, const ForceSettings& force);
/// Work [J] against the drag over `length` [m] at constant speed [m/s] and depth.
double drag_work(double depth, double speed, double length, const ForceSettings& force);
/// Share of a disk of this radius that lies within `half_width` of a line through its centre.
double strip_share_of_disk(double radius, double half_width);

}  // namespace sandstroke
