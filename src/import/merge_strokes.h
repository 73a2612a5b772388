#pragma once

#include <string>

#include "import/stroke_of_table.h"

namespace sandstroke {

/// Gives a stroke the force and the orientation of a second one at its own times: forces are interpolated
/// linearly, orientations along the shortest turn. If both have a clock, its stamps tell how the times belong
/// together; shift [s] is added to those of the second. Samples outside the second's time, or in its gaps,
/// are left out, with a warning. Error: input, if the second has neither, or they share no time.
void merge_strokes(ImportedStroke& first, const ImportedStroke& second, double shift,
                   const std::string& first_name, const std::string& second_name);

}  // namespace sandstroke
