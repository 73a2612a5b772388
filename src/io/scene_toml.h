#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/scene_file.h"

namespace sandstroke {

/// Reads a scene (TOML) and checks it. overrides: "key=value" as --set takes them. Error: input, naming file,
/// line, key and remedy; io where the file cannot be read. Only an override may take the stroke from standard
/// input ("stroke.file=-").
SceneFile load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

/// The same from text; `name` stands for the file in messages.
SceneFile scene_from_text(const std::string& text, const std::string& name,
                          const std::vector<std::string>& overrides = {});

/// The scene that an earlier run stored, for looking at its results. It passes over the old key
/// relaxation.travel, a way in cells.
SceneFile stored_scene(const std::string& text, const std::string& name);

/// The path of the scene's stroke, from `folder`, the scene's; "-": standard input.
std::filesystem::path stroke_path(const Scene& scene, const std::filesystem::path& folder);

/// The files that a scene names, from `folder`, the scene's: stroke, the table that is merged with it,
/// surface, mesh, plugin.
std::vector<std::filesystem::path> input_files(const Scene& scene, const std::filesystem::path& folder);

/// True for a key of older scenes and run files with a value that changes nothing.
bool is_void(const std::string& key, const std::string& literal);

/// Every setting of a scene as TOML. Reading it back gives the same scene.
std::string scene_text(const SceneFile& scene);

}  // namespace sandstroke
