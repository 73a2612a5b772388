#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "tool/triangle_mesh.h"

namespace sandstroke {

/// Two triangles of a mesh that pass through each other by more than `tolerance` [m], or lie on each other
/// over more than that; the first found, or none. Triangles narrower than that do not count. Takes n log n
/// for n triangles of a surface that does not overlap itself.
std::optional<std::pair<std::size_t, std::size_t>> overlapping_triangles(const TriangleMesh& mesh,
                                                                         double tolerance);

}  // namespace sandstroke
