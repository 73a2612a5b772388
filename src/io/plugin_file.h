#pragma once

#include <filesystem>
#include <memory>

#include "sim/own_laws.h"

namespace sandstroke {

/// The laws of a plugin (sim/plugin.h), a shared library, which stays loaded until the program ends. It runs
/// what is in it. Error: input or io, naming the file: where it is none, was built for another sandstroke, or
/// has no laws.
std::shared_ptr<const OwnLaws> load_plugin(const std::filesystem::path& path);

/// The same settings with the laws of their plugin loaded, where they name one (relative to `folder`).
OwnLawSettings with_plugin(OwnLawSettings own, const std::filesystem::path& folder);

/// Error: input, where the scene has a force law of its own, and its stroke is a script that presses by
/// force: the depth of a force is known for the paper's law only.
void check_own_force(const Scene& scene, const std::filesystem::path& stroke_file);

}  // namespace sandstroke
