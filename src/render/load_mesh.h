#pragma once

#include "sand/carried_sand.h"
#include "tool/triangle_mesh.h"

namespace sandstroke {

/// The surface of the sand on a tool as triangles, on the bed's axes, with the tip at the origin.
TriangleMesh load_mesh(const LoadSurface& load);

}  // namespace sandstroke
