#pragma once

#include <string>

#include "sim/scene.h"

namespace sandstroke {

/// What no single key of [tool] can tell: that they go with each other, with the laws and with the bed. A
/// mesh that was not read is not looked at. Error: input, naming the keys; `name` is the scene's file.
void check_tool(const Scene& scene, const std::string& name);

}  // namespace sandstroke
