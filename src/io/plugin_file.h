#pragma once

#include <filesystem>
#include <memory>

#include "sim/own_laws.h"

namespace sandstroke {

/// Loads a plugin (sim/plugin.h), a shared library, and returns its laws. This runs the plugin's code. It
/// stays loaded until the program ends. Error: input or io, naming the file, if it is no plugin, was built
/// for another sandstroke, or has no laws.
std::shared_ptr<const OwnLaws> load_plugin(const std::filesystem::path& path);

/// The same settings with the laws of their plugin loaded, if they name one (relative to `folder`).
OwnLawSettings with_plugin(OwnLawSettings own, const std::filesystem::path& folder);

/// Error: input, if the scene has a force law from a plugin, and its stroke is a script that presses by
/// force: the depth of a force is known for the paper's law only.
void check_own_force(const Scene& scene, const std::filesystem::path& stroke_file);

}  // namespace sandstroke
