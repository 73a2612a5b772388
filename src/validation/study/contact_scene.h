#pragma once

#include "haptics/stroke.h"
#include "sim/scene.h"

namespace sandstroke {

/// A flat square bed [m] that does not relax while the tool moves, so that the sand's level is what a closed
/// form says; a device without a limit of force.
Scene contact_scene(double width, int cells, double servo_rate);

/// Uniformly from place to place [m], `seconds` each: for as long as there are places.
Stroke straight(const std::vector<Eigen::Vector3d>& places, const std::vector<double>& seconds);

}  // namespace sandstroke
