#include "compare/scene_difference.h"

#include <spdlog/fmt/fmt.h>

#include "core/error.h"
#include "io/scene_toml.h"
#include "io/toml_reader.h"

namespace sandstroke {

namespace {

/// The scene, completed with the defaults of settings that are newer than it.
std::string completed(const std::string& scene) {
  try {
    return scene_text(stored_scene(scene, "the golden scene"));
  } catch (const Error&) {  // it has settings that are not there any more
    return scene;
  }
}

}  // namespace

std::string scene_difference(const std::string& golden, const std::string& run) {
  const TomlReader before = TomlReader::from_text(golden, "the golden scene"),
                   after = TomlReader::from_text(run, "the run's scene"),
                   by_default = TomlReader::from_text(completed(golden), "the golden scene");
  std::vector<std::string> changes;
  for (const std::string& key : before.keys_in("")) {
    const std::string was = before.literal(key), is = after.literal(key);
    if (is_void(key, was)) continue;
    if (was != is)
      changes.push_back(is.empty() ? fmt::format("{} was {}, is gone", key, was)
                                   : fmt::format("{} was {}, is {}", key, was, is));
  }
  for (const std::string& key : after.keys_in(""))
    if (!before.has(key) && by_default.literal(key) != after.literal(key))
      changes.push_back(fmt::format("{} is new, {}", key, after.literal(key)));
  return fmt::format("{}", fmt::join(changes, "; "));
}

}  // namespace sandstroke
