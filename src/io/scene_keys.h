#pragma once

#include <string>
#include <vector>

#include "sim/scene.h"

namespace sandstroke {

/// One setting of a scene, as describe_scene() tells of it.
struct SceneKey {
  std::string name;   ///< dotted, as --set takes it
  std::string value;  ///< as TOML text
  std::string unit;   ///< empty: none
  std::string range;  ///< in words; empty: any number, or no number
  std::string help;
  std::vector<std::string> choices;  ///< what it can be; empty: not one of a few names
  std::vector<std::string> presets;  ///< "accurate: 240.0": what a preset makes of it

  /// The name within its section.
  std::string key() const { return name.substr(name.rfind('.') + 1); }
  /// In a sentence: its help, what it can be, and what presets make of it.
  std::string explanation() const;
};

struct SceneSection {
  std::string name, help;
  std::vector<SceneKey> keys;
};

/// The settings that this scene has, with its values, in the order of a scene file.
std::vector<SceneSection> scene_settings(const Scene& scene);

/// Every key that some scene can have, with its default: also those that only go with a choice (the radius of
/// a cone).
std::vector<SceneSection> all_scene_keys();

/// Unit of a setting that this scene has, by its dotted name; empty: none, or no such setting.
std::string setting_unit(const Scene& scene, const std::string& name);

/// all_scene_keys() as aligned lines: key, default, unit, meaning (for help pages).
std::string scene_key_table();

}  // namespace sandstroke
