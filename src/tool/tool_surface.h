#pragma once

#include <Eigen/Geometry>

#include "tool/tool_settings.h"

namespace sandstroke {

/// The surface of any tool in its own frame [m], tip at the origin, before it is turned. Round shapes have so
/// many corners that the mesh lies at most 1e-4 radii inside the true surface. A rake's teeth are cylinders
/// with hemispheres at their ends, under a beam. A shovel is open in front, where x is largest. Error: input,
/// where a mesh was not read.
TriangleMesh tool_surface(const ToolSettings& settings);

/// The rotation of the tool's own frame in the bed while the hand is not turned (ToolSettings::orientation).
Eigen::Matrix3d own_rotation(const ToolSettings& settings);

/// How far the tool, turned by own_rotation(), reaches from the vertical axis through its tip [m]. A sphere
/// reaches its radius. A mesh that was not read reaches 0.
double tool_reach(const ToolSettings& settings);

/// The rotation of a unit quaternion, rounded to multiples of 2^-50. A quarter turn is exact.
Eigen::Matrix3d rotation_of(const Eigen::Quaterniond& orientation);

/// A mesh turned about the origin.
TriangleMesh turned(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation);

}  // namespace sandstroke
