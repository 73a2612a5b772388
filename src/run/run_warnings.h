#pragma once

#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// Warns of what a run should not have come to: a tool that touched nothing, a furrow that is not as deep as
/// the hand went, a loop that returned energy or swings, sand that is not at rest.
void warn_of_run(const RunResult& result, const Scene& scene);

}  // namespace sandstroke
