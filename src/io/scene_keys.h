#pragma once

#include <string>
#include <vector>

#include "io/key_table.h"
#include "io/scene_file.h"

namespace sandstroke {

/// The settings of this scene, with its values, in the order of a scene file.
std::vector<KeySection> scene_settings(const SceneFile& scene);

/// Every key that some scene can have.
std::vector<KeySection> all_scene_keys();

/// Unit of a setting that this scene has, by its dotted name; empty: none, or no such setting.
std::string setting_unit(const SceneFile& scene, const std::string& name);

}  // namespace sandstroke
