#include "io/scene_toml.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/input_file.h"
#include "import/sample_files.h"
#include "io/input_kind.h"
#include "io/key_reader.h"
#include "io/scene_keys.h"
#include "io/toml_path.h"
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

const std::map<std::string, std::string>& scene_conditions() {
  static const std::map<std::string, std::string> known = [] {
    std::map<std::string, std::string> all = conditions(all_scene_keys());
    for (const char* key : {"ground", "ground.stiffness"}) all[key] = "there is a bed.floor or a [[stone]]";
    return all;
  }();
  return known;
}

TomlReader reader_of(const SceneText& text) {
  TomlReader toml = TomlReader::from_text(text.text, text.name);
  for (const std::string& assignment : text.own) toml.override_with(assignment);
  return toml;
}

/// Reads all keys. leave_out: which of those that do not apply are passed over.
SceneFile scene_of(const TomlReader& toml, Written written, const TomlReader::LeaveOut& leave_out) {
  SceneFile scene;
  read_keys(toml, [&](KeyVisitor& visitor) { describe_scene_file(visitor, scene); });
  toml.skip("relaxation.engine");  // in older scenes and run files: all engines gave the same bits
  if (constexpr const char* travel = "relaxation.travel"; toml.has(travel)) {
    if (written == Written::by_a_user && !is_void(travel, toml.literal(travel)))
      toml.fail(travel, "was replaced by relaxation.way, in tool radii instead of cells; set that");
    toml.skip(travel);
  }
  toml.reject_unread(scene_conditions, leave_out);
  return scene;
}

/// The keys of a text that do not apply even without overrides.
std::set<std::string> unused_by_itself(const SceneText& text) {
  std::set<std::string> unused;
  try {
    scene_of(reader_of(text), Written::by_a_user, [&](const std::string& key, const std::string&) {
      unused.insert(key);
      return true;
    });
  } catch (const Error&) {  // the text is a scene only with overrides
  }
  return unused;
}

/// True if one of the overrides gives the key, or a table around it, a value.
bool sets(const std::vector<std::string>& overrides, const std::string& key) {
  return std::any_of(overrides.begin(), overrides.end(), [&](const std::string& one) {
    const std::string given = one.substr(0, one.find('='));
    return key == given || key.starts_with(given + ".");
  });
}

SceneFile read_scene(const SceneText& text, const std::vector<std::string>& overrides,
                     std::vector<LeftOut>& left_out) {
  TomlReader toml = reader_of(text);
  for (const std::string& assignment : overrides) toml.override_with(assignment);
  std::optional<std::set<std::string>> unused;
  SceneFile scene =
      scene_of(toml, Written::by_a_user, [&](const std::string& key, const std::string& condition) {
        if (overrides.empty() || sets(overrides, key)) return false;
        if (!unused) unused = unused_by_itself(text);
        if (unused->contains(key)) return false;
        left_out.push_back({key, condition});
        return true;
      });
  check(scene, toml);
  return scene;
}

/// Names the file from the current folder, if an override gave it and it is not beside the scene.
void find_given_file(std::string& file, const std::string& key, const std::vector<std::string>& overrides,
                     const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (!sets(overrides, key) || file.empty() || file == "-" || fs::path(file).is_absolute() ||
      !fs::exists(file, none))
    return;
  if (!fs::exists(folder / file, none)) {
    file = fs::absolute(file).string();
  } else if (!fs::equivalent(folder / file, file, none)) {
    spdlog::info("--set {}={}: takes {}, beside the scene, not the file of that name in this folder", key,
                 file, (folder / file).string());
  }
}

}  // namespace

std::string left_out_text(const std::vector<LeftOut>& left_out) {
  std::vector<std::string> conditions, sentences;
  for (const LeftOut& one : left_out)
    if (std::find(conditions.begin(), conditions.end(), one.condition) == conditions.end())
      conditions.push_back(one.condition);
  for (const std::string& condition : conditions) {
    std::vector<std::string> keys;
    for (const LeftOut& one : left_out)
      if (one.condition == condition) keys.push_back(one.key);
    const bool single = keys.size() == 1;
    sentences.push_back(fmt::format("{} {} left out, because {} only where {}", fmt::join(keys, ", "),
                                    single ? "is" : "are", single ? "it applies" : "they apply", condition));
  }
  return fmt::format("{}", fmt::join(sentences, "; "));
}

bool is_void(const std::string& key, const std::string& literal) {
  return key == "relaxation.travel" && literal == "0";
}

SceneFile load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                     std::vector<LeftOut>* left_out) {
  return read_as({InputKind::scene}, path, [&] {
    const SceneText text{read_text_file(path), path.string()};
    const TomlReader toml = TomlReader::from_text(text.text, text.name);
    if (toml.has("stroke") && toml.text("stroke.file", "") == "-")
      throw_input_error(
          "{}: stroke.file = \"-\" names no file; to play standard input, leave it out and "
          "give --stroke - to sandstroke run",
          path.string());
    std::vector<LeftOut> unused;
    SceneFile scene = read_scene(text, overrides, unused);
    const std::filesystem::path folder = folder_of(path);
    find_given_file(scene.bed.surface.file, "bed.surface.file", overrides, folder);
    find_given_file(scene.tool.file, "tool.file", overrides, folder);
    if (scene.ground.map) find_given_file(scene.ground.map->file, "sand.map.file", overrides, folder);
    for (std::size_t i = 0; i < scene.ground.stones.size(); ++i)
      find_given_file(scene.ground.stones[i].file, fmt::format("stone.{}.file", i + 1), overrides, folder);
    find_given_file(scene.plugin_laws.plugin, "model.plugin", overrides, folder);
    if (scene.stroke) {
      find_given_file(scene.stroke->file, "stroke.file", overrides, folder);
      const std::filesystem::path stroke = folder / scene.stroke->file;
      // Who starts a run may give it a pipe; a stranger's scene that names one would wait for ever.
      if (is_pipe(stroke) && !sets(overrides, "stroke.file")) check_readable(stroke);
    }
    if (left_out)
      left_out->insert(left_out->end(), unused.begin(), unused.end());
    else if (!unused.empty())
      spdlog::info("{}: {}", path.string(), left_out_text(unused));
    return scene;
  });
}

SceneFile scene_from_text(const SceneText& text, const std::vector<std::string>& overrides,
                          std::vector<LeftOut>* left_out) {
  std::vector<LeftOut> unused;
  SceneFile scene = read_scene(text, overrides, unused);
  if (left_out) left_out->insert(left_out->end(), unused.begin(), unused.end());
  return scene;
}

SceneFile combined_scene(const SceneText& text, const std::vector<std::string>& overrides,
                         std::vector<LeftOut>& left_out) {
  TomlReader toml = reader_of(text);
  for (const std::string& assignment : overrides) toml.override_with(assignment);
  SceneFile scene =
      scene_of(toml, Written::by_a_user, [&](const std::string& key, const std::string& condition) {
        left_out.push_back({key, condition});
        return true;
      });
  check(scene, toml);
  return scene;
}

bool applies_conditionally(const std::string& key) {
  return scene_conditions().contains(at_first_places(key));
}

SceneFile stored_scene(const std::string& text, const std::string& name) {
  const TomlReader toml = TomlReader::from_text(text, name);
  const SceneFile scene = scene_of(toml, Written::by_a_run, {});
  check(scene, toml);
  return scene;
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
  if (scene.ground.map) files.push_back(folder / scene.ground.map->file);
  for (const StoneSettings& stone : scene.ground.stones)
    if (stone.shape == StoneShape::mesh) files.push_back(folder / stone.file);
  if (!scene.plugin_laws.plugin.empty()) files.push_back(folder / scene.plugin_laws.plugin);
  for (const SourceSettings& source : scene.sources)
    if (!source.path.empty()) files.push_back(folder / source.path);
  return files;
}

std::string scene_text(const SceneFile& scene) {
  std::string text;
  for (const KeySection& section : scene_settings(scene)) {
    text += fmt::format("{}{}\n", text.empty() ? "" : "\n", section.header());
    for (const KeyRow& key : section.keys) text += fmt::format("{} = {}\n", key.key(), key.value);
  }
  return text;
}

}  // namespace sandstroke
