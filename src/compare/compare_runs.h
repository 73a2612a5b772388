#pragma once

#include "compare/check.h"
#include "compare/run_checks.h"
#include "io/run_file.h"

namespace sandstroke {

/// Two run files: complete, the same bed, initial and final surface, and the trace where there is one (in
/// both, or in neither). The comparison has the run's name.
Comparison compare_runs(const RunFile& golden, const RunFile& run, const Tolerances& tolerances);

}  // namespace sandstroke
