#pragma once

#include <vector>

#include "core/warning.h"
#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// The warnings that a result gives rise to: the tool touched nothing, the furrow is not as deep as the hand
/// went, it went into the floor, the loop returned energy or swings, or the sand is not at rest. Does not log
/// them.
std::vector<Warning> warnings_of_run(const RunResult& result, const Scene& scene);

}  // namespace sandstroke
