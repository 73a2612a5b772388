#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// What a run amounts to, in SI units: `run --json`. output: its file. Not-a-number becomes null.
nlohmann::ordered_json run_summary(const RunResult& result, const Scene& scene, const std::string& output);

/// {"height_share": ..., ...}
nlohmann::ordered_json error_json(const ErrorEstimate& error);

}  // namespace sandstroke
