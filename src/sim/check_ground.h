#pragma once

#include <string>

#include "sim/scene.h"

namespace sandstroke {

/// What no single key of bed.floor, [[sand.region]], [[sand.layer]], [[stone]] and [ground] can tell: that
/// they are where the bed is, and go with its laws. A mesh that was not read is not looked at. Error: input,
/// naming the keys; `name` is the scene's file.
void check_ground(const Scene& scene, const std::string& name);

}  // namespace sandstroke
