#pragma once

#include <string>

#include "core/key_visitor.h"
#include "sim/scene.h"

namespace sandstroke {

/// Shows bed.floor; the visitor is in the section bed.
void describe_floor(KeyVisitor& visitor, GroundSettings& ground);
/// Shows [[sand.region]], [[stone]] and [ground].
void describe_ground(KeyVisitor& visitor, GroundSettings& ground);

/// What no single key of them can tell: that they are where the bed is, and go with its laws. A mesh that was
/// not read is not looked at. Error: input, naming the keys; `name` is the scene's file.
void check_ground(const Scene& scene, const std::string& name);

/// About what the ground takes [bytes], with the sand that it lifts.
double memory_of_ground(const Scene& scene);

}  // namespace sandstroke
