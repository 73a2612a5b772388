#include "io/scene_toml.h"

#include <spdlog/fmt/fmt.h>
#include <cmath>

#include <algorithm>
#include <functional>
#include <set>

#include "core/output_file.h"
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
  void number(const char* key, double& value, Range range, const char*, const char*) override {
    value = toml_.number(prefix_ + key, value, range);
  }
  void numbers(const char* key, double* values, int count, Range range, const char*, const char*) override {
    const auto read = toml_.numbers(prefix_ + key, std::vector<double>(values, values + count), range);
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

/// Tells key, value as TOML text, unit and meaning of each setting to one function.
class SceneLister : public SceneVisitor {
 public:
  struct Entry {
    std::string key, value, unit, help;
  };
  using Tell = std::function<void(const Entry&)>;
  using TellSection = std::function<void(const std::string& name, const std::string& help)>;

  SceneLister(TellSection tell_section, Tell tell)
      : tell_section_(std::move(tell_section)), tell_(std::move(tell)) {}

  void section(const char* name, const char* help) override { tell_section_(name, help); }
  bool optional_section(const char* name, bool present, const char* help) override {
    if (present) section(name, help);
    return present;
  }
  void number(const char* key, double& value, Range, const char* unit, const char* help) override {
    tell_({key, literal(value), unit, help});
  }
  void numbers(const char* key, double* values, int count, Range, const char* unit,
               const char* help) override {
    std::vector<std::string> literals;
    for (int i = 0; i < count; ++i) literals.push_back(literal(values[i]));
    tell_({key, fmt::format("[{}]", fmt::join(literals, ", ")), unit, help});
  }
  void integers(const char* key, int* values, int count, int, int, const char* help) override {
    const std::string list = fmt::format("{}", fmt::join(values, values + count, ", "));
    tell_({key, count == 1 ? list : "[" + list + "]", "", help});
  }
  void flag(const char* key, bool& value, const char* help) override {
    tell_({key, value ? "true" : "false", "", help});
  }
  void text(const char* key, std::string& value, const char* help) override {
    tell_({key, toml_string(value), "", help});
  }
  void choice(const char* key, int& value, const std::vector<std::string>& names, const char* help) override {
    tell_({key, '"' + names[value] + '"', "", fmt::format("{} ({})", help, fmt::join(names, " | "))});
  }
  bool reads() const override { return false; }

 private:
  /// The shortest digits that give the same number back; with a point or exponent, as TOML wants of a float.
  static std::string literal(double value) {
    std::string digits = fmt::format("{}", value);
    if (digits.find_first_of(".en") == std::string::npos) digits += ".0";
    return digits;
  }

  TellSection tell_section_;
  Tell tell_;
};

Scene read_scene(TomlReader toml, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) toml.override_with(assignment);
  Scene scene;
  SceneReader reader(toml);
  describe_scene(reader, scene);
  toml.reject_unread();
  check_scene(scene, toml.name());
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  return read_scene(TomlReader::from_file(path), overrides);
}

Scene scene_from_text(const std::string& text, const std::string& name,
                      const std::vector<std::string>& overrides) {
  return read_scene(TomlReader::from_text(text, name), overrides);
}

std::string scene_text(const Scene& scene) {
  std::string text;
  SceneLister writer(
      [&](const std::string& name, const std::string&) {
        text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", name);
      },
      [&](const SceneLister::Entry& entry) { text += fmt::format("{} = {}\n", entry.key, entry.value); });
  Scene copy = scene;  // a visitor could change it; this one does not
  describe_scene(writer, copy);
  return text;
}

std::string setting_unit(const Scene& scene, const std::string& key) {
  std::string unit, prefix;
  SceneLister lister([&](const std::string& name, const std::string&) { prefix = name + "."; },
                     [&](const SceneLister::Entry& entry) {
                       if (prefix + entry.key == key) unit = entry.unit;
                     });
  Scene copy = scene;
  describe_scene(lister, copy);
  return unit;
}

namespace {

/// Default scenes but for this key, with keys of its section that only other choices of it have.
std::vector<Scene> scenes_with_more_keys(const std::string& key) {
  std::vector<Scene> scenes;
  if (key == "bed.surface.kind")
    for (const SurfaceKind kind :
         {SurfaceKind::cylinder, SurfaceKind::noise, SurfaceKind::ripples, SurfaceKind::file})
      scenes.emplace_back().bed.surface.kind = kind;
  if (key == "relaxation.method") scenes.emplace_back().relaxation.method = RelaxationMethod::rkl;
  if (key == "device.model") scenes.emplace_back().device.model = DeviceModel::dynamic;
  return scenes;
}

}  // namespace

std::string scene_key_table() {
  std::string table;
  std::string prefix;
  std::set<std::string> shown;  // a key that several choices have is shown once
  const auto show = [&](const SceneLister::Entry& entry) {
    const std::string key = prefix + entry.key;
    if (shown.insert(key).second)
      table += fmt::format("  {:<28} {:<14} {:<7} {}\n", key, entry.value, entry.unit, entry.help);
  };
  SceneLister lister(
      [&](const std::string& name, const std::string& help) {
        prefix = name + ".";
        if (shown.insert("[" + name + "]").second)
          table += fmt::format("{}[{}]  {}\n", table.empty() ? "" : "\n", name, help);
      },
      [&](const SceneLister::Entry& entry) {
        show(entry);
        const std::string section = prefix;
        for (const Scene& other : scenes_with_more_keys(section + entry.key)) {
          SceneLister more([&](const std::string& name, const std::string&) { prefix = name + "."; },
                           [&](const SceneLister::Entry& key) {
                             if (prefix == section) show(key);
                           });
          Scene shown_to = other;
          describe_scene(more, shown_to);
        }
        prefix = section;
      });
  Scene defaults;
  defaults.stroke.emplace();
  describe_scene(lister, defaults);
  return table;
}

}  // namespace sandstroke
