#pragma once

#include <string>

#include "tool/triangle_mesh.h"

namespace sandstroke {

// Sand meets a tool's outer surface, and that only once. Both functions need a mesh in which a corner is one
// vertex. `name`: the file's.

/// The mesh with each triangle once, with a warning if that changes it. Two triangles that lie on each other
/// and face each other, as where two parts touch, are inside the tool: both are left out. If that would
/// leave none of a body, its surface is two-sided, and the first of each counts.
TriangleMesh with_triangles_once(const TriangleMesh& mesh, const std::string& name);

/// The bodies (parts that share no corner) that lie in no other one, with a warning of those that do: solids,
/// and cavities that sand cannot enter. A body that is inside out is turned, with a warning. Needs a closed
/// surface. Error: input, naming where, if bodies overlap or touch with a part of a face, if a surface passes
/// through itself, or if there are too many bodies.
TriangleMesh outermost_bodies(const TriangleMesh& mesh, const std::string& name);

}  // namespace sandstroke
