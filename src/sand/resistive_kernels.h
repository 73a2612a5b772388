#pragma once

#include "sand/resistive_force.h"
#include "sand/strength_by_place.h"

namespace sandstroke {

/// The input of one tick of resistive force theory. Vector code (Highway), the same bits for every
/// instruction set.
struct ResistiveTick {
  const ToolElements& elements;
  const SandBefore& before;
  double* ways;       ///< x, y, z of each element's displacement, in yield ways; updated
  double tip_height;  ///< m
  SandBefore::Motion motion;
  double resistance;  ///< N/m^3, xi
  double tool_friction;
  const StrengthByPlace* places;  ///< that looked at these elements; null: sand is the same everywhere
};
Wrench resistive_wrench(const ResistiveTick& tick);

}  // namespace sandstroke
