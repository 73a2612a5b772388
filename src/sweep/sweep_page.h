#pragma once

#include <nlohmann/json.hpp>

#include "sweep/collected_sweep.h"

namespace sandstroke {

/// Beyond so many points the page has no thumbnails: it would be too large to open.
inline constexpr std::size_t most_thumbnails = 2000;

/// What sweep.js shows: title, machine, scene, design, axes, metrics, points and counts. What cannot be shown
/// is said in the report's sentences.
nlohmann::ordered_json sweep_page_data(const CollectedSweep& sweep, CollectReport& report);

}  // namespace sandstroke
