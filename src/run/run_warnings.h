#pragma once

#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// Warns if the tool touched nothing, the furrow is not as deep as the hand went, the loop returned energy or
/// swings, or the sand is not at rest.
void warn_of_run(const RunResult& result, const Scene& scene);

}  // namespace sandstroke
