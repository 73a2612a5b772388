#pragma once

#include <string>

#include "io/height_map.h"
#include "sim/scene.h"

namespace sandstroke {

/// The heights [m] of a bed's cells that a map gives: area means, if its cells are others, so that the volume
/// stays. bed.surface says how the map is scaled, and what cells without data become. Beyond a round bed's
/// wall they need none. Says in the log what it changed. `name` stands for the file. Error: input, if the map
/// does not fit the bed's length and width, lacks data, or has heights that no bed has.
HeightGrid heights_on_bed(HeightMap& map, const BedSettings& bed, const std::string& name);

/// Error: input, if a height [m] is beyond all that a bed of this size has. `what` names the heights.
void check_heights(double lowest, double highest, const BedSettings& bed, const std::string& what);

/// Refuses cells without a value, which is not-a-number, unless they are beyond the bed's wall: these become
/// `beyond_wall`. `way_out` ends the sentence, and `value` is the word for one. Error: input, with their
/// number.
void check_no_gaps(HeightGrid& values, const BedSettings& bed, const std::string& name,
                   const std::string& way_out, const char* value = "height", double beyond_wall = 0.0);

}  // namespace sandstroke
