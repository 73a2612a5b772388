#pragma once

#include "rules/standing.h"

namespace sandstroke {

/// A straight cut through level moist sand, in cells of the bed's grid.
struct StandingCut {
  double face = 90.0;      ///< deg, of its face
  double friction = 33.0;  ///< deg
  double turn = 0.0;       ///< deg, of its normal from +x towards +y
  double shift = 0.0;      ///< cells, of its foot along the normal
  int cells = 20;          ///< to its critical height
};

/// By how much higher than the failure surface says the rule lets it stand, as a fraction: by bisection. Only
/// the middle of its foot is looked at, for its ends lie at the bed's edge.
double height_error(const StandingCut& cut, SlipSurface surface);

}  // namespace sandstroke
