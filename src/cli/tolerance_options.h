#pragma once

#include "cli/commands.h"
#include "compare/tolerances.h"

namespace sandstroke {

/// Adds an option for each tolerance. golden: refuses tolerances that the rounding of golden entries would
/// fail.
void add_tolerance_options(CLI::App& command, GivenTolerances& given, bool golden);

}  // namespace sandstroke
