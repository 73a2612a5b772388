#pragma once

#include <nlohmann/json.hpp>

#include "io/last_surface.h"
#include "sim/furrow.h"

namespace sandstroke {

/// Heights of the initial and the last surface as a part of a page: of the cells along the way of the tip, by
/// its length while it touched the sand, and of those across it at its middle, 6 tool radii [m] to either
/// side, left of the way positive. Cells are taken as they are, a cell apart (further, where that would be
/// more than 100,000). A way that stays within half a radius is only crossed, along y. The path has a point
/// at least. Error: input, where a point is not finite.
nlohmann::ordered_json profiles_part(const TipPath& path, double tool_radius, const HeightField& initial,
                                     const LastSurface& last);

}  // namespace sandstroke
