#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sweep/collected_sweep.h"

namespace sandstroke {

/// With more points the page has no thumbnails: it would be too large to open.
inline constexpr std::size_t most_thumbnails = 2000;

/// The data for sweep.js: title, machine, scene, design, axes, metrics, points and counts. Adds a sentence to
/// the report for what cannot be shown.
nlohmann::ordered_json sweep_page_data(const CollectedSweep& sweep, CollectReport& report);

/// The page that draws them, as HTML.
std::string sweep_page(const nlohmann::ordered_json& data);

}  // namespace sandstroke
