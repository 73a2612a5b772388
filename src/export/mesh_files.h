#pragma once

#include <ostream>

#include "core/output_file.h"
#include "export/bed_mesh.h"

namespace sandstroke {

/// A format of triangles, in mm: none of the formats names a unit, and printing programs take mm.
struct MeshFormat {
  OutputKind kind;
  double most_vertices, most_triangles;          ///< that the format can count
  double (*bytes)(const MeshSize& size);         ///< about how large a file becomes
  bool (*write)(std::ostream&, const BedMesh&);  ///< writes a whole file; false: interrupted()
};

extern const MeshFormat stl_format;  ///< binary, with normals
extern const MeshFormat ply_format;  ///< binary
extern const MeshFormat obj_format;

}  // namespace sandstroke
