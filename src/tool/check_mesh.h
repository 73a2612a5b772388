#pragma once

#include <string>

#include "tool/triangle_mesh.h"

namespace sandstroke {

/// The same surface with each corner once, and no triangles without area; turned outside out where all of it
/// was inside out, which is warned of. Error: input, with what to do, where it is no closed surface of a
/// solid, too large for a tool (an extent above 1 m, as of millimetres taken for metres), far from its tip
/// (the origin), or of too many triangles. `name`: the file's.
TriangleMesh checked_mesh(const TriangleMesh& mesh, const std::string& name);

}  // namespace sandstroke
