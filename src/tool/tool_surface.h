#pragma once

#include <Eigen/Geometry>

#include "tool/tool_settings.h"

namespace sandstroke {

/// The surface of any tool in its own frame [m], tip at the origin, before it is turned. Round shapes have so
/// many corners that no point of them is farther than 1e-4 radii inside the surface. A rake's teeth are
/// cylinders with hemispheres at their ends, under a beam. Error: input, of a mesh that was not read.
TriangleMesh tool_surface(const ToolSettings& settings);

/// How the tool's own frame lies in the bed while the hand is not turned (ToolSettings::orientation).
Eigen::Matrix3d own_rotation(const ToolSettings& settings);

/// How far the tool, as it is held, reaches from the vertical axis through its tip [m]: of a sphere its
/// radius. Of a mesh that was not read: 0.
double tool_reach(const ToolSettings& settings);

/// The rotation of a unit quaternion, rounded to multiples of 2^-50: a quarter turn is exactly one.
Eigen::Matrix3d rotation_of(const Eigen::Quaterniond& orientation);

/// A mesh turned about the origin.
TriangleMesh turned(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation);

}  // namespace sandstroke
