#pragma once

#include "haptics/stroke.h"
#include "sim/scene.h"

namespace sandstroke {

/// A flat square bed, `width` [m] wide, and a device without a force limit. The sand does not relax while the
/// tool moves, so its level follows a closed form.
Scene contact_scene(double width, int cells, double servo_rate);

/// The same at 1 kHz with the preset accurate and this tool, solid. The sand never relaxes.
Scene solid_contact_scene(double width, int cells, const ToolSettings& tool);

/// A stroke that moves uniformly from position to position [m]; seconds[i] is the time of the i-th move.
Stroke straight(const std::vector<Eigen::Vector3d>& positions, const std::vector<double>& seconds);

}  // namespace sandstroke
