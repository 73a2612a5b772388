#pragma once

#include "validation/study/planar_stress.h"
#include "validation/study/problem.h"

namespace sandstroke {

/// The plate's stress (planar_stress.h) by force.law = "rft", divided by the sand's resistance() and the
/// depth: no unit. The plate has the default tool friction.
PlanarStress law_stress(double tilt, double dive);

/// Charts of the law's vertical and horizontal stress over the direction of motion, for some tilts, beside
/// two-dimensional resistive force theory and a measured medium. Each is in units of its own flat plate
/// pushed straight down, because the theories scale with different properties of the sand.
std::vector<Plot> stress_plots();

/// Measured figures, with the law's beside them.
std::vector<MeasuredFigure> measured_stresses();

}  // namespace sandstroke
