#include "io/scene_keys.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "io/toml_reader.h"

namespace sandstroke {
namespace {

/// Collects what describe_scene() shows.
class SceneLister : public SceneVisitor {
 public:
  std::vector<SceneSection> sections;

  void section(const char* name, const char* help) override { sections.push_back({name, help, {}}); }
  bool optional_section(const char* name, bool present, const char* help) override {
    if (present) section(name, help);
    return present;
  }
  void number(const char* key, double& value, Range range, const char* unit, const char* help) override {
    add(key, literal(value), help, unit, range);
  }
  void numbers(const char* key, double* values, int count, Range range, const char* unit,
               const char* help) override {
    std::vector<std::string> literals;
    for (int i = 0; i < count; ++i) literals.push_back(literal(values[i]));
    add(key, fmt::format("[{}]", fmt::join(literals, ", ")), help, unit, range);
  }
  void integers(const char* key, int* values, int count, int lowest, int highest, const char* help) override {
    const std::string list = fmt::format("{}", fmt::join(values, values + count, ", "));
    const bool bounded = highest < std::numeric_limits<int>::max();
    add(key, count == 1 ? list : "[" + list + "]", help, "",
        {static_cast<double>(lowest), bounded ? static_cast<double>(highest) : any_number.highest});
  }
  void flag(const char* key, bool& value, const char* help) override {
    add(key, value ? "true" : "false", help).choices = {"true", "false"};
  }
  void text(const char* key, std::string& value, const char* help) override {
    add(key, toml_string(value), help);
  }
  void choice(const char* key, int& value, const std::vector<std::string>& names, const char* help) override {
    add(key, '"' + names[value] + '"', help).choices = names;
  }
  bool reads() const override { return false; }

 private:
  SceneKey& add(const std::string& key, const std::string& value, const std::string& help,
                const std::string& unit = "", Range range = any_number) {
    SceneSection& section = sections.back();
    section.keys.push_back({section.name + "." + key, value, unit, range_text(range), help, {}, {}});
    return section.keys.back();
  }

  /// The shortest digits that give the same number back; with a point or exponent, as TOML wants of a float.
  static std::string literal(double value) {
    std::string digits = fmt::format("{}", value);
    if (digits.find_first_of(".en") == std::string::npos) digits += ".0";
    return digits;
  }
};

/// Makes one choice, with what it stands for, as if read from a file.
class SceneChooser : public SceneVisitor {
 public:
  SceneChooser(std::string name, std::string chosen) : name_(std::move(name)), chosen_(std::move(chosen)) {}

  void section(const char* name, const char*) override { prefix_ = std::string(name) + "."; }
  bool optional_section(const char* name, bool present, const char* help) override {
    section(name, help);
    return present;
  }
  void choice(const char* key, int& value, const std::vector<std::string>& names, const char*) override {
    if (prefix_ + key == name_)
      value = static_cast<int>(std::find(names.begin(), names.end(), chosen_) - names.begin());
  }
  void number(const char*, double&, Range, const char*, const char*) override {}
  void numbers(const char*, double*, int, Range, const char*, const char*) override {}
  void integers(const char*, int*, int, int, int, const char*) override {}
  void flag(const char*, bool&, const char*) override {}
  void text(const char*, std::string&, const char*) override {}
  bool reads() const override { return true; }

 private:
  std::string name_, chosen_, prefix_;
};

/// Default settings, but for one choice; no name: none.
std::vector<SceneSection> settings_with(const std::string& name, const std::string& chosen) {
  Scene scene;
  scene.stroke.emplace();
  SceneChooser chooser(name, chosen);
  describe_scene(chooser, scene);
  return scene_settings(scene);
}

/// Adds keys that are not there yet, each before the key it precedes in `more`.
void merge(std::vector<SceneKey>& keys, const std::vector<SceneKey>& more) {
  auto place = keys.end();
  for (auto key = more.rbegin(); key != more.rend(); ++key) {
    const auto same = [&](const SceneKey& other) { return other.name == key->name; };
    const auto found = std::find_if(keys.begin(), keys.end(), same);
    place = found != keys.end() ? found : keys.insert(place, *key);
  }
}

}  // namespace

std::string SceneKey::explanation() const {
  std::string sentence = help;
  if (!choices.empty()) sentence += fmt::format(" ({})", fmt::join(choices, " | "));
  if (!range.empty()) sentence += "; " + range;
  if (!presets.empty()) sentence += fmt::format("; with preset {}", fmt::join(presets, ", "));
  return sentence;
}

std::vector<SceneSection> scene_settings(const Scene& scene) {
  SceneLister lister;
  Scene copy = scene;  // a visitor could change it; this one does not
  describe_scene(lister, copy);
  return std::move(lister.sections);
}

std::vector<SceneSection> all_scene_keys() {
  const std::vector<SceneSection> base = settings_with("", "");
  std::vector<SceneSection> all = base;
  for (const SceneSection& section : base) {
    for (const SceneKey& by : section.keys) {
      for (const std::string& chosen : by.choices) {
        const std::vector<SceneSection> other = settings_with(by.name, chosen);
        for (std::size_t i = 0; i < all.size(); ++i) {
          merge(all[i].keys, other[i].keys);
          if (by.key() != "preset") continue;
          for (SceneKey& key : all[i].keys) {
            const auto same = [&](const SceneKey& one) { return one.name == key.name; };
            const auto made = std::find_if(other[i].keys.begin(), other[i].keys.end(), same);
            if (made != other[i].keys.end() && made->value != key.value && key.name != by.name)
              key.presets.push_back(chosen + ": " + made->value);
          }
        }
      }
    }
  }
  return all;
}

std::string setting_unit(const Scene& scene, const std::string& name) {
  for (const SceneSection& section : scene_settings(scene))
    for (const SceneKey& key : section.keys)
      if (key.name == name) return key.unit;
  return {};
}

std::string scene_key_table() {
  std::string table;
  for (const SceneSection& section : all_scene_keys()) {
    table += fmt::format("{}[{}]  {}\n", table.empty() ? "" : "\n", section.name, section.help);
    for (const SceneKey& key : section.keys)
      table += fmt::format("  {:<28} {:<14} {:<7} {}\n", key.name, key.value, key.unit, key.explanation());
  }
  return table;
}

}  // namespace sandstroke
