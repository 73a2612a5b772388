#include "io/scene_toml.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/input_kind.h"
#include "io/scene_keys.h"
#include "io/toml_reader.h"

namespace sandstroke {
namespace {

/// Gives each setting the value in the file, if there is one.
class SceneReader : public SceneVisitor {
 public:
  explicit SceneReader(const TomlReader& toml) : toml_(toml) {}

  void section(const char* name, const char*) override {
    prefix_ = std::string(name) + ".";
    toml_.has(name);
  }
  bool optional_section(const char* name, bool, const char* help) override {
    section(name, help);
    return toml_.has(name);
  }
  void number(const char* key, double& value, Range range, const char* unit, const char*) override {
    value = toml_.number(prefix_ + key, value, range, unit);
  }
  void numbers(const char* key, double* values, int count, Range range, const char* unit,
               const char*) override {
    const auto read = toml_.numbers(prefix_ + key, std::vector<double>(values, values + count), range, unit);
    std::copy(read.begin(), read.end(), values);
  }
  void integers(const char* key, int* values, int count, int lowest, int highest, const char*) override {
    if (count == 1) {
      values[0] = toml_.integer(prefix_ + key, values[0], lowest, highest);
      return;
    }
    const Range range{static_cast<double>(lowest), static_cast<double>(highest), false};
    const auto read = toml_.numbers(prefix_ + key, std::vector<double>(values, values + count), range);
    for (int i = 0; i < count; ++i) {
      if (read[i] != std::floor(read[i]))
        toml_.fail(prefix_ + key, fmt::format("is {}; give integers", read[i]));
      values[i] = static_cast<int>(read[i]);
    }
  }
  void flag(const char* key, bool& value, const char*) override {
    value = toml_.boolean(prefix_ + key, value);
  }
  void text(const char* key, std::string& value, const char*) override {
    value = toml_.text(prefix_ + key, value);
  }
  void choice(const char* key, int& value, const std::vector<std::string>& names, const char*) override {
    value = toml_.choice(prefix_ + key, value, names);
  }
  bool reads() const override { return true; }

 private:
  const TomlReader& toml_;
  std::string prefix_;
};

/// What is wrong is said of the --set that gave it, where one did, and else of the file.
void check(const Scene& scene, const TomlReader& toml) {
  try {
    check_scene(scene, toml.name());
  } catch (const Error& failure) {
    const std::string overrides = toml.overrides_in(failure.what());
    if (overrides.empty()) throw;
    check_scene(scene, overrides);
    throw;  // not reached, unless memory was given free meanwhile
  }
}

/// Run files, and scenes of that time, name the engine; there is only one now.
void skip_engine(const TomlReader& toml) {
  const std::string engine = toml.text("relaxation.engine", "tiles");
  if (engine != "tiles")
    toml.fail("relaxation.engine",
              fmt::format("is '{}'; leave it out: there is one engine, with the same results", engine));
}

Scene read_scene(TomlReader toml, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) toml.override_with(assignment);
  Scene scene;
  SceneReader reader(toml);
  describe_scene(reader, scene);
  skip_engine(toml);
  toml.reject_unread();
  check(scene, toml);
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  expect_kind(path, {InputKind::scene});
  return read_scene(TomlReader::from_file(path), overrides);
}

Scene scene_from_text(const std::string& text, const std::string& name,
                      const std::vector<std::string>& overrides) {
  return read_scene(TomlReader::from_text(text, name), overrides);
}

std::string scene_text(const Scene& scene) {
  std::string text;
  for (const SceneSection& section : scene_settings(scene)) {
    text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section.name);
    for (const SceneKey& key : section.keys) text += fmt::format("{} = {}\n", key.key(), key.value);
  }
  return text;
}

}  // namespace sandstroke
