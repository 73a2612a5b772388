#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/scene_file.h"

namespace sandstroke {

/// A setting that the others do not use, and where it applies: "tool.shape is sphere".
struct LeftOut {
  std::string key, condition;
};

/// "tool.radius and tool.profile are left out, because they apply only where tool.shape is sphere", for each
/// condition; empty: nothing is left out.
std::string left_out_text(const std::vector<LeftOut>& left_out);

/// Reads a scene (TOML) and checks it. overrides: "key=value" as --set takes them, "!key" as --unset. An
/// override may replace what other settings belong to: what the file sets for the old choice is then left
/// out, and logged or, if `left_out` is given, added to it. A file that an override names is looked for
/// beside the scene, then in the current folder. Error: input, naming file, line, key and remedy; io where
/// the file cannot be read. Only an override may take the stroke from standard input ("stroke.file=-").
SceneFile load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides = {},
                     std::vector<LeftOut>* left_out = nullptr);

/// A scene's text. `name` stands for the file in messages; `own` are overrides that belong to the text, as if
/// written in it.
struct SceneText {
  std::string text, name;
  std::vector<std::string> own = {};
};

/// The same from text. Does not log what is left out.
SceneFile scene_from_text(const SceneText& text, const std::vector<std::string>& overrides = {},
                          std::vector<LeftOut>* left_out = nullptr);
inline SceneFile scene_from_text(const std::string& text, const std::string& name,
                                 const std::vector<std::string>& overrides = {}) {
  return scene_from_text(SceneText{text, name}, overrides);
}

/// The same where settings are combined that nobody chose for each other, as in a sweep: whatever the others
/// do not use is left out, also if it was an override.
SceneFile combined_scene(const SceneText& text, const std::vector<std::string>& overrides,
                         std::vector<LeftOut>& left_out);

/// True if the key applies only with some choices of others, as tool.width with tool.shape = "plate".
bool applies_conditionally(const std::string& key);

/// The scene that an earlier run stored, for looking at its results. It passes over the old key
/// relaxation.travel, a way in cells.
SceneFile stored_scene(const std::string& text, const std::string& name);

/// The path of the scene's stroke, from `folder`, the scene's; "-": standard input.
std::filesystem::path stroke_path(const Scene& scene, const std::filesystem::path& folder);

/// The files that a scene names, from `folder`, the scene's: stroke, the table that is merged with it,
/// surface, meshes, plugin.
std::vector<std::filesystem::path> input_files(const Scene& scene, const std::filesystem::path& folder);

/// True for a key of older scenes and run files with a value that changes nothing.
bool is_void(const std::string& key, const std::string& literal);

/// Every setting of a scene as TOML. Reading it back gives the same scene.
std::string scene_text(const SceneFile& scene);

}  // namespace sandstroke
