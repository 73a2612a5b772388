#pragma once

#include "picture/view.h"
#include "sim/scene.h"

namespace sandstroke {

/// The content of a scene file: the settings of a run, and how its pictures show the sand.
struct SceneFile : Scene {
  ViewSettings view = {};
};

/// Shows every setting to the visitor, in the order of the file: first those of the run.
void describe_scene_file(KeyVisitor& visitor, SceneFile& scene);

}  // namespace sandstroke
