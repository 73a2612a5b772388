#pragma once

#include <vector>

namespace sandstroke {

/// A granular medium in two-dimensional resistive force theory: the Fourier coefficients of the stress on a
/// plate over its depth [N/cm^3], fitted to measurements (Li, Zhang, Goldman, Science 339, 2013, supplement,
/// table S2). The generic medium has what all media have in common, scaled so that the stress on a flat plate
/// that is pushed straight down is 1. NaN: not known here.
struct PlanarMedium {
  const char* name;
  double a00, a10, b11, b01, b_11;  ///< of the vertical stress; b_11: m = -1, n = 1
  double c11, c01, c_11, d10;       ///< of the horizontal one
};

extern const PlanarMedium generic_medium;
/// The coefficients are from public programs that cite the table. The glass spheres have only vertical ones:
/// one of the horizontal coefficients found was a generic one.
extern const std::vector<PlanarMedium> measured_media;

/// The stress of the sand on the plate over its depth, N/cm^3.
struct PlanarStress {
  double up;       ///< vertical
  double against;  ///< horizontal, against the motion's horizontal part
};

/// The stress on a plate that is tilted by `tilt` (beta; 0: flat; positive: its lower face looks ahead) and
/// moves along `dive` (gamma; 0: level, pi/2: straight down), both from -pi/2 to pi/2 rad: up = sum over m =
/// -1..1, n = 0..1 of A_mn cos(2 m beta + n gamma) + B_mn sin(2 m beta + n gamma), and against = the same
/// with C and D. The plate is thin: the sand acts on the face that leads.
PlanarStress planar_stress(const PlanarMedium& medium, double tilt, double dive);

}  // namespace sandstroke
