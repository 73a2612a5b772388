#pragma once

#include <optional>

#include "compare/check.h"
#include "compare/run_checks.h"
#include "io/run_file.h"

namespace sandstroke {

/// Every tick of a run; none where it has no trace.
std::optional<CountedTrace> whole_trace(const RunFile& run);

/// Two run files: complete, the same bed, initial and final surface, and the trace where there is one (in
/// both, or in neither). The comparison has the run's name.
Comparison compare_runs(const RunFile& golden, const RunFile& run, const Tolerances& tolerances);

}  // namespace sandstroke
