#pragma once

#include "validation/study/planar_stress.h"
#include "validation/study/problem.h"

namespace sandstroke {

/// What force.law = "rft" says of such a plate (planar_stress.h), over the sand's resistance() and the depth:
/// no unit. The plate's friction is that of a scene that names none.
PlanarStress law_stress(double tilt, double dive);

/// The law's vertical and horizontal stress over the direction of motion, for some tilts, beside
/// two-dimensional resistive force theory and a medium as it was measured. Each in units of its own flat
/// plate pushed straight down, for the theories scale with different properties of the sand.
std::vector<Plot> stress_plots();

/// The law beside measured figures.
std::vector<MeasuredFigure> measured_stresses();

}  // namespace sandstroke
