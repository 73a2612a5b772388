#pragma once

#include <filesystem>

#include "tool/tool_settings.h"

namespace sandstroke {

/// Reads the surface in an STL file, binary or text, as a tool's (checked_mesh). scale: m per unit of the
/// file. Error: input or io, naming the file by `name`.
TriangleMesh parse_mesh(const std::string& bytes, double scale, const std::string& name);
TriangleMesh read_mesh(const std::filesystem::path& path, double scale);

/// The same tool; if it is a mesh, with that mesh read (tool.file, relative to `folder`).
ToolSettings with_mesh(ToolSettings tool, const std::filesystem::path& folder);

}  // namespace sandstroke
