#pragma once

#include <string>

#include "sim/scene.h"

namespace sandstroke {

/// Checks a scene's sources, and their paths where these are loaded: that each does something, stops where no
/// stroke ends the run, stays over the bed, and has no more sand in the air than memory takes. Error: input,
/// naming the key; `name` is the scene's file.
void check_sources(const Scene& scene, const std::string& name);

}  // namespace sandstroke
