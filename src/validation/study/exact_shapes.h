#pragma once

#include <functional>

#include "rules/force.h"
#include "sand/relaxation.h"

namespace sandstroke {

// Closed forms of the shapes in which sand comes to rest, and of a device's work.
// Heights and lengths in m, talus angles in deg. The shapes hold for the isotropic law. Those that do not
// change along y or along x hold for the paper's law as well. The crater has one shape for each law.

/// Height at (x, y).
using ExactSurface = std::function<double(double x, double y)>;

/// A truncated cone on a flat bed around the origin. The talus slope lies between the radii `plateau` and
/// `foot`.
struct ExactCone {
  double slope, plateau, foot;
  double top() const { return slope * (foot - plateau); }
  double volume() const;  ///< m^3; a full cone's is pi foot^3 slope / 3: what stays on a disc of that radius
  double operator()(double x, double y) const;
};
/// The rest shape of a cylinder: a full cone if height >= sqrt(3) radius tan(talus), else a truncated one.
ExactCone collapsed_cylinder(double radius, double height, double talus_angle);
/// The rest shape of a cone steeper than the talus: the talus cone of its volume.
ExactCone collapsed_cone(double radius, double height, double talus_angle);

/// The rest shape of a cliff from `height` (x < 0) down to 0: a ramp centred on its edge.
struct ExactRamp {
  double slope, height;
  double operator()(double x, double y) const;
};
ExactRamp collapsed_cliff(double height, double talus_angle);

/// The rest shape of a slot along y, 2 `half_width` wide and `depth` deep: a V. Holds if the V is shallower
/// and wider than the slot (depth > 2 tan(talus) half_width).
struct ExactTrench {
  double slope, half_width;
  double depth() const { return slope * half_width; }
  double operator()(double x, double y) const;
};
ExactTrench filled_slot(double half_width, double depth, double talus_angle);

/// The sand that stays on a sphere around the origin: a cone that touches the sphere where that is as steep
/// as the talus.
struct ExactCap {
  double slope, radius;
  double foot() const { return slope * top() / (1.0 + slope * slope); }
  /// The cone's tip over the sphere's centre.
  double top() const;
  double volume() const;
  /// Thickness of the sand.
  double operator()(double x, double y) const;
};

/// The sand that stays on a round plate, which is turned by `tilt` [deg] about the y axis through its middle:
/// the highest surface that is nowhere steeper than `slope` and ends at the rim.
struct ExactHeapOnPlate {
  double slope, radius, tilt;
  /// m^3, by quadrature, to 1e-3 of itself; 0 where the plate is as steep as the sand.
  double volume() const;
};

/// The rest shape of a slope down along x over a seam of two sands, whose slopes are `before` and `behind` x
/// = `seam`: two lines that meet there at z = 0.
struct ExactSeam {
  double before, behind, seam;
  double operator()(double x, double y) const;
  /// The mean height from x - width / 2 to x + width / 2.
  double mean(double x, double width) const;
};

/// The rest shape of a flat bed that drained through a hole at the origin, down to `depth`: a cone under the
/// isotropic law, an octagonal pyramid under the paper's.
struct ExactCrater {
  RelaxationLaw law;
  double slope, depth;
  double operator()(double x, double y) const;
};
ExactCrater drained_crater(double depth, double talus_angle, RelaxationLaw law);

/// Length of the shortest path along axes and diagonals: the distance in the paper's law.
double octile_distance(double x, double y);

/// Work [J] of pushing the tip at constant speed into undisturbed sand, without drag.
double plunge_work(double depth, const ForceSettings& force);
/// Work [J] against the drag over `length` [m] at constant speed [m/s] and depth.
double drag_work(double depth, double speed, double length, const ForceSettings& force);
/// Fraction of a disk's area that lies within `half_width` of a line through its centre.
double strip_fraction_of_disk(double radius, double half_width);

}  // namespace sandstroke
