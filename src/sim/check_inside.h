#pragma once

#include "haptics/stroke.h"
#include "sand/height_field.h"
#include "sim/scene.h"

namespace sandstroke {

/// Error: input, with what brings it onto the bed, if the stroke may enter sand outside the bed: where it is
/// below the surface's highest possible point. stroke: as place_stroke() returns it.
void check_inside(const Stroke& stroke, const Scene& scene, const HeightField& bed);

}  // namespace sandstroke
