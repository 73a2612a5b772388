#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "haptics/stroke.h"

namespace sandstroke {

/// The plane with the least squared distances (total least squares) from some points.
struct LeastSquaresPlane {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit; z >= 0
  Eigen::Vector3d widths = Eigen::Vector3d::Zero();   ///< m, rms: thickness, width and length
  double largest = 0.0;                               ///< m, largest distance of a point

  double rms() const { return widths[0]; }                          ///< m, of the distances
  bool is_line() const { return !(widths[1] > 1e-6 * widths[2]); }  ///< any plane through it fits
  /// Whether it is less than twice as wide as it is thick: then no plane describes the points well.
  bool is_thick() const { return widths[1] < 2.0 * widths[0]; }
  double tilt() const;  ///< deg, of the normal against z, 0 to 90
};
LeastSquaresPlane plane_through(const std::vector<Eigen::Vector3d>& points);

/// The positions at which the pen is down.
std::vector<Eigen::Vector3d> drawn_points(const Stroke& stroke);

/// Returns a warning if the drawn samples begin or end far off the plane of their middle three fifths. An
/// approach or a lift without pen states does that: it tilts a plane through all, and is no part of the
/// tracing. Otherwise empty. `name` is the stroke's.
std::string off_plane_warning(const Stroke& stroke, const std::string& name);

/// Which way is up from a traced plane: `automatic`, or an axis of the stroke's frame.
enum class StrokeUp { automatic, x, y, z, minus_x, minus_y, minus_z };
inline const std::vector<std::string> stroke_up_names = {"auto", "x", "y", "z", "-x", "-y", "-z"};

/// The normal of a stroke's plane that points up.
struct UpNormal {
  Eigen::Vector3d normal;
  StrokeUp axis;        ///< the axis nearest to it
  bool lifted = false;  ///< the samples with the pen up decided it
};

/// The normal that points up. A given axis must be within 45 deg of the normal. `automatic` takes the side on
/// which the samples with the pen up lie, if that is clearly off the plane; otherwise the frame's axis that
/// is nearest to the normal, in its positive direction. If that is not z, the plane is upright. A plunge, a
/// drag and a lift are in such a plane, and laid level they would lie on their side. So an upright plane must
/// hold a tracing: over half of its way is more than 10 deg off both z and the horizontal. Error: input,
/// which says what to set; `name` is the stroke's.
UpNormal up_normal(const Stroke& stroke, const LeastSquaresPlane& plane, StrokeUp up,
                   const std::string& name);

}  // namespace sandstroke
