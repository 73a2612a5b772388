#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// The results of a run in SI units, for `run --json`. output: the run file. NaN becomes null.
nlohmann::ordered_json run_summary(const RunResult& result, const Scene& scene, const std::string& output);

/// "poured 0.1 kg, landed ..." in the words of people.
std::string text_of(const SourceLedger& source);

/// "took up 0.1 kg, carried ..." in the words of people. density [kg/m^3]: of the sand in bulk.
std::string text_of(const LoadLedger& load, double density);

/// [{"poured": ...}, ...]
nlohmann::ordered_json sources_json(const std::vector<SourceLedger>& sources);

/// {"lifted": ...}
nlohmann::ordered_json load_json(const LoadLedger& load);

/// {"height_share": ..., ...}
nlohmann::ordered_json error_json(const ErrorEstimate& error);

}  // namespace sandstroke
