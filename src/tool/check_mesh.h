#pragma once

#include <string>

#include "tool/triangle_mesh.h"

namespace sandstroke {

/// The outer surface with each corner and each triangle once (mesh_bodies.h), and no triangles without area.
/// A mesh that is inside out is turned, with a warning. Error: input, with what to do, where the mesh is no
/// closed surface of a solid, is too large for a tool (an extent above 1 m, as when millimetres are taken for
/// metres), is far from its tip (the origin), or has too many triangles. `name`: the file's.
TriangleMesh checked_mesh(const TriangleMesh& mesh, const std::string& name);

}  // namespace sandstroke
