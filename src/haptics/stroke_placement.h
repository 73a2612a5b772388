#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>

#include "haptics/stroke.h"

namespace sandstroke {

/// keep: as recorded. fit: the plane through the tracing is laid level, with the tracing's centre on the
/// origin.
enum class StrokePlane { keep, fit };

/// Where a stroke goes on the bed ([stroke] in a scene).
struct StrokePlacement {
  double scale = 1.0;                                ///< of positions and velocities, > 0
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m
  double rotate_z = 0.0;                             ///< deg, from +x towards +y
  StrokePlane plane = StrokePlane::keep;
  double depth = 0.0;  ///< m, how far below z = 0 the fitted plane is laid
  double start = 0.0;  ///< s after the first sample: earlier samples are cut
  double stop = std::numeric_limits<double>::infinity();  ///< s after the first sample: later samples are cut
};

/// Cuts all columns to the samples from begin to before end.
void keep_samples(Stroke& stroke, std::size_t begin, std::size_t end);

/// Where single points of a stroke go; all of a placement but the fit of a plane, which needs the whole
/// stroke.
struct PointPlacement {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< from the stroke's frame to the bed's
  double scale = 1.0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< about z
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< m

  Eigen::Vector3d position(const Eigen::Vector3d& p) const { return turn * (scale * (axes * p)) + shift; }
  /// The point that is placed there.
  Eigen::Vector3d position_back(const Eigen::Vector3d& placed) const {
    return axes.transpose() * (turn.transpose() * (placed - shift)) / scale;
  }
  Eigen::Vector3d force(const Eigen::Vector3d& force) const { return turn * (axes * force); }
  /// A force on the bed's axes, on those of the stroke's frame.
  Eigen::Vector3d force_back(const Eigen::Vector3d& force) const {
    return axes.transpose() * (turn.transpose() * force);
  }
};

/// frame "device": a haptic device's axes, +x towards the operator, +y to the operator's right; the operator
/// sits at the bed's -y.
PointPlacement point_placement(const StrokePlacement& placement, const std::string& frame);

/// The stroke as it is played: cut to start..stop, turned from the device's axes (frame "device") to the
/// bed's, laid level (plane = fit), scaled, turned about z, lowered by `depth`, moved by `offset`; its time
/// begins at 0. Velocities turn and scale with it, forces and orientations turn.
///
/// The fitted plane is the least-squares plane (total least squares) through the samples at which the pen is
/// down. It is turned by the smallest rotation that makes it level and shifted onto z = 0; bumps about the
/// plane stay. Error: input, naming the stroke by `name`, where nothing is left of it, or its samples span no
/// plane or one steeper than 45 deg.
Stroke place_stroke(const Stroke& stroke, const StrokePlacement& placement,
                    const std::string& name = "stroke");

}  // namespace sandstroke
