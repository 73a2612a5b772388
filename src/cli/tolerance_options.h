#pragma once

#include "cli/commands.h"
#include "compare/tolerances.h"

namespace sandstroke {

/// An option for each tolerance. golden: one that the rounding of golden entries would fail is refused.
void add_tolerance_options(CLI::App& command, GivenTolerances& given, bool golden);

}  // namespace sandstroke
