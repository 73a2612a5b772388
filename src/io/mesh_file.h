#pragma once

#include <filesystem>

#include "sand/ground_settings.h"
#include "tool/check_mesh.h"
#include "tool/tool_settings.h"

namespace sandstroke {

/// Reads the surface in an STL file, binary or text, for this use (checked_mesh). scale: m per unit of the
/// file. Error: input or io, naming the file by `name`.
TriangleMesh parse_mesh(const std::string& bytes, double scale, const std::string& name,
                        const MeshUse& use = {});
TriangleMesh read_mesh(const std::filesystem::path& path, double scale, const MeshUse& use = {});

/// The same tool; if it is a mesh, with that mesh read (tool.file, relative to `folder`).
ToolSettings with_mesh(ToolSettings tool, const std::filesystem::path& folder);
/// The same ground, with the meshes of its stones read (stone.N.file, relative to `folder`).
GroundSettings with_meshes(GroundSettings ground, const std::filesystem::path& folder);

}  // namespace sandstroke
