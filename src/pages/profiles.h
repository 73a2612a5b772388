#pragma once

#include <nlohmann/json.hpp>

#include "io/run_file.h"
#include "measure/furrow.h"

namespace sandstroke {

/// A part of a page with profiles of the initial and the last surface. One goes along the path of the tip
/// while it touched the sand. One crosses the path at its middle, 6 tool radii [m] to either side; left of
/// the path is positive. Heights are those of cells, taken a cell apart (further, where there would be more
/// than 100,000). A path shorter than half a radius is only crossed, along y where the tip did not move. The
/// path has a point at least. Error: input, where a point is not finite.
nlohmann::ordered_json profiles_part(const TipPath& path, double tool_radius, const HeightField& initial,
                                     const LastSurface& last);

}  // namespace sandstroke
