#pragma once

#include "sand/resistive_force.h"

namespace sandstroke {

/// The input of one tick of resistive force theory. Vector code (Highway), the same bits for every
/// instruction set.
struct ResistiveTick {
  const ToolFootprint& footprint;
  const ToolElements& elements;
  double* ways;  ///< x, y, z of each element's displacement, in yield ways; updated
  Eigen::Vector3d tip;
  SandPlane plane;
  Eigen::Vector3d motion;  ///< of the tip, in yield ways
  Eigen::Matrix3d spin;  ///< 1/m; times an element's position: its motion relative to the tip, in yield ways
  double resistance;     ///< N/m^3, xi
  double tool_friction, yield_way;
};
Wrench resistive_wrench(const ResistiveTick& tick);

}  // namespace sandstroke
