#pragma once

#include <filesystem>
#include <memory>

#include "sim/plugin_laws.h"

namespace sandstroke {

/// Loads a plugin (sim/plugin.h), a shared library, and returns its laws. This runs the plugin's code. It
/// stays loaded until the program ends. Error: input or io, naming the file, if it is no plugin, was built
/// for another sandstroke, or has no laws.
std::shared_ptr<const PluginLaws> load_plugin(const std::filesystem::path& path);

/// The same settings with the laws of their plugin loaded, if they name one (relative to `folder`).
PluginLawSettings with_plugin(PluginLawSettings own, const std::filesystem::path& folder);

/// Error: input, if the scene has a force law from a plugin, and its stroke is a script that presses by
/// force: the depth of a force is known for the paper's law only.
void check_plugin_force(const Scene& scene, const std::filesystem::path& stroke_file);

}  // namespace sandstroke
