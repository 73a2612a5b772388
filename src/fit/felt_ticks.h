#pragma once

#include "fit/contact_law.h"
#include "fit/felt_stroke.h"
#include "fit/paper_law.h"

namespace sandstroke {

/// The ticks of a run in which the tool touches sand and a force was recorded. The run shows a bar and stops
/// if it is interrupted. Error: input, unstable.
std::vector<FeltTick> felt_ticks(const FeltStroke& felt);

/// The same for a law of the contact, with the force in each of the grid's sands.
ContactLaw felt_in(const FeltStroke& felt, SandGrid grid);

}  // namespace sandstroke
