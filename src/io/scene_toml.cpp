#include "io/scene_toml.h"

#include <spdlog/fmt/fmt.h>

#include "core/error.h"
#include "import/import_stroke.h"
#include "io/input_kind.h"
#include "io/key_reader.h"
#include "io/scene_keys.h"
#include "io/toml_reader.h"

namespace sandstroke {
namespace {

/// Checks the scene. An error names the --set that gave the value, if one did, and else the file.
void check(const Scene& scene, const TomlReader& toml) {
  try {
    check_scene(scene, toml.name());
  } catch (const Error& failure) {
    const std::string overrides = toml.overrides_in(failure.what());
    if (overrides.empty()) throw;
    check_scene(scene, overrides);
    throw;  // reached only if memory has become free meanwhile
  }
}

enum class Written { by_a_user, by_a_run };

SceneFile read_scene(TomlReader toml, const std::vector<std::string>& overrides,
                     Written written = Written::by_a_user) {
  for (const std::string& assignment : overrides) toml.override_with(assignment);
  SceneFile scene;
  read_keys(toml, [&](KeyVisitor& visitor) { describe_scene_file(visitor, scene); });
  toml.skip("relaxation.engine");  // in older scenes and run files: all engines gave the same bits
  if (constexpr const char* travel = "relaxation.travel"; toml.has(travel)) {
    if (written == Written::by_a_user && !is_void(travel, toml.literal(travel)))
      toml.fail(travel, "was replaced by relaxation.way, in tool radii instead of cells; set that");
    toml.skip(travel);
  }
  toml.reject_unread([] { return conditions(all_scene_keys()); });
  check(scene, toml);
  return scene;
}

}  // namespace

bool is_void(const std::string& key, const std::string& literal) {
  return key == "relaxation.travel" && literal == "0";
}

SceneFile load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  return read_as({InputKind::scene}, path, [&] {
    TomlReader toml = TomlReader::from_file(path);
    if (toml.has("stroke") && toml.text("stroke.file", "") == "-")
      throw_input_error(
          "{}: stroke.file = \"-\" names no file; to play standard input, leave it out and "
          "give --stroke - to sandstroke run",
          path.string());
    return read_scene(std::move(toml), overrides);
  });
}

SceneFile scene_from_text(const std::string& text, const std::string& name,
                          const std::vector<std::string>& overrides) {
  return read_scene(TomlReader::from_text(text, name), overrides);
}

SceneFile stored_scene(const std::string& text, const std::string& name) {
  return read_scene(TomlReader::from_text(text, name), {}, Written::by_a_run);
}

std::filesystem::path stroke_path(const Scene& scene, const std::filesystem::path& folder) {
  return scene.stroke->file == "-" ? "-" : folder / scene.stroke->file;
}

std::vector<std::filesystem::path> input_files(const Scene& scene, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (scene.stroke)
    files = sample_files(stroke_path(scene, folder), scene.stroke->table.value_or(TableSettings{}));
  if (scene.bed.surface.kind == SurfaceKind::file) files.push_back(folder / scene.bed.surface.file);
  if (scene.tool.shape == ToolShape::mesh) files.push_back(folder / scene.tool.file);
  if (!scene.plugin_laws.plugin.empty()) files.push_back(folder / scene.plugin_laws.plugin);
  return files;
}

std::string scene_text(const SceneFile& scene) {
  std::string text;
  for (const KeySection& section : scene_settings(scene)) {
    text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section.name);
    for (const KeyRow& key : section.keys) text += fmt::format("{} = {}\n", key.key(), key.value);
  }
  return text;
}

}  // namespace sandstroke
