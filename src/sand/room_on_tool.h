#pragma once

#include "sand/upper_side.h"

namespace sandstroke {

/// The volume of the largest heap that can lie on a tool [m^3].
struct RoomOnTool {
  double in_cells;  ///< as the upper side is in its cells
  double
      within_edges;  ///< where each edge of the tool, however thin the wall under it, raises the nearest cell
};
/// surface: of which `upper` was made. slope: of the talus.
RoomOnTool room_on_tool(const UpperSide& upper, const TriangleMesh& surface, double slope);

}  // namespace sandstroke
