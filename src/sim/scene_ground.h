#pragma once

#include <string>

#include "core/key_visitor.h"
#include "sim/scene.h"

namespace sandstroke {

/// Shows bed.floor; the visitor is in the section bed.
void describe_floor(KeyVisitor& visitor, GroundSettings& ground);
/// Shows [sand.map], [[sand.region]], [[sand.layer]], [[stone]] and [ground].
void describe_ground(KeyVisitor& visitor, GroundSettings& ground);

/// The width of the band around a border in which the force goes over to another sand [m]: force.blend. A
/// tool's mesh must have been read.
double strength_blend(const Scene& scene);

/// About what the ground takes [bytes], with the sand that it lifts.
double memory_of_ground(const Scene& scene);

}  // namespace sandstroke
