#pragma once

#include "haptics/stroke.h"
#include "sim/scene.h"

namespace sandstroke {

/// A scene of a few cells.
Scene small_scene();

/// Does what `run` does with a stroke: places it in both ways, looks where the hand is throughout,
/// and plays its first ticks on a small bed.
void play(const Stroke& stroke);

/// Runs a scene for a few ticks and a few passes, where its bed is small.
void play(Scene scene);

}  // namespace sandstroke
