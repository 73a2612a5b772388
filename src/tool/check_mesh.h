#pragma once

#include <string>

#include "tool/triangle_mesh.h"

namespace sandstroke {

/// What a mesh is for: words of the errors.
struct MeshUse {
  std::string what = "tool", scale_key = "tool.scale", origin = "must be the tool's tip";
  double largest = 1.0;  ///< extent [m]
};

/// The outer surface with each corner and each triangle once (mesh_bodies.h), and no triangles without area.
/// A mesh that is inside out is turned, with a warning. Error: input, with what to do, where the mesh is no
/// closed surface of a solid, is too large for its use (as when millimetres are taken for metres), is far
/// from its origin, or has too many triangles. `name`: the file's.
TriangleMesh checked_mesh(const TriangleMesh& mesh, const std::string& name, const MeshUse& use = {});

}  // namespace sandstroke
