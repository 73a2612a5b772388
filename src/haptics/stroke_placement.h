#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <string>

#include "haptics/repeated_samples.h"
#include "haptics/stroke.h"
#include "haptics/stroke_plane.h"

namespace sandstroke {

/// keep: as recorded. fit: the plane through the tracing is laid level, with the tracing's centre on the
/// origin. flatten: the same, and the tracing is moved onto the plane.
enum class StrokePlane { keep, fit, flatten };
/// The zero of a stroke's heights: the bed's z = 0, or the sand as it lies under the tip.
enum class StrokeFollow { bed, sand };
/// none: `depth` everywhere. pressure, force: `depth` where the recorded pressure, or the size of the
/// recorded force, is largest, and in proportion elsewhere.
enum class DepthBy { none, pressure, force };
inline const std::vector<std::string> depth_by_names = {"none", "pressure", "force"};
/// keep: where it is. centre: the middle of its drawn extent goes onto the middle of the bed.
enum class StrokePlace { keep, centre };

/// How a stroke is placed on the bed ([stroke] in a scene).
struct StrokePlacement {
  double scale = 1.0;  ///< of positions and velocities, > 0
  double fit = 0.0;    ///< > 0: the fraction of the bed's width or depth that it fills, instead of the scale
  StrokePlace place = StrokePlace::keep;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m
  double rotate_z = 0.0;                             ///< deg, from +x towards +y
  StrokePlane plane = StrokePlane::keep;
  StrokeUp up = StrokeUp::automatic;  ///< of the plane
  double depth = 0.0;                 ///< m, how far below z = 0 the fitted plane is laid
  DepthBy depth_by = DepthBy::none;
  double full_depth_at = 0.0;  ///< the pressure, or force [N], of full depth; 0: the largest of the stroke
  StrokeFollow follow = StrokeFollow::bed;
  RepeatedSamples repeated = RepeatedSamples::keep;
  double smooth = 0.0;  ///< Hz, cut-off of the filter against tremble and noise (smoothed); 0: none
  double speed = 1.0;   ///< times faster, > 0
  double start = 0.0;   ///< s after the first sample: earlier samples are cut
  double stop = std::numeric_limits<double>::infinity();  ///< s after the first sample: later samples are cut
};

/// The placement of single points of a stroke. It has all of a placement but the fit of a plane, which needs
/// the whole stroke.
struct PointPlacement {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< from the stroke's frame to the bed's
  double scale = 1.0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< about z
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< m

  Eigen::Vector3d position(const Eigen::Vector3d& p) const { return turn * (scale * (axes * p)) + shift; }
  /// The inverse: the point that is placed at `placed`.
  Eigen::Vector3d position_back(const Eigen::Vector3d& placed) const {
    return axes.transpose() * (turn.transpose() * (placed - shift)) / scale;
  }
  Eigen::Vector3d force(const Eigen::Vector3d& force) const { return turn * (axes * force); }
  /// A hand that is not turned in its frame is not turned on the bed.
  Eigen::Quaterniond orientation(const Eigen::Quaterniond& q) const {
    const Eigen::Quaterniond to_bed(axes);
    return Eigen::Quaterniond(turn) * to_bed * q * to_bed.conjugate();
  }
  /// Converts a force from the bed's axes to those of the stroke's frame.
  Eigen::Vector3d force_back(const Eigen::Vector3d& force) const {
    return axes.transpose() * (turn.transpose() * force);
  }
};

/// frame "device": a haptic device's axes, +x towards the operator, +y to the operator's right; the operator
/// sits at the bed's -y.
PointPlacement point_placement(const StrokePlacement& placement, const std::string& frame);

/// The stroke as it is played: cut to start..stop, without repeated samples, smoothed, turned from the
/// device's axes (frame "device") to the bed's, laid level (plane), scaled, turned about z, lowered by
/// `depth`, brought onto the bed (place), moved by `offset`; its time begins at 0, and is `speed` times
/// shorter. Times that were made for a speed of the tip (Stroke::tip_speed) give that speed at the size on
/// the bed. Velocities turn and scale with it, forces and orientations turn. The drawn extent is that of the
/// samples at which the pen is down. `bed` [m]: the bed's rectangle, for fit and place.
///
/// The plane is the least-squares plane through the samples at which the pen is down (plane_through). It is
/// turned by the smallest rotation that brings up_normal() to z, and shifted onto z = 0; bumps about the
/// plane stay, except with flatten. With depth_by, a drawn sample goes no deeper than `depth`, and one
/// without pressure (or force) not at all. Error: input, naming the stroke by `name`, if nothing is left of
/// it, its samples span no plane or are no tracing in one, it has no extent to fit, or depth_by finds no
/// pressure, or heights that differ without a plane.
Stroke place_stroke(const Stroke& stroke, const StrokePlacement& placement,
                    const std::string& name = "stroke", const Eigen::AlignedBox2d& bed = {});

}  // namespace sandstroke
