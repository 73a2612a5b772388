#include "io/scene_file.h"

namespace sandstroke {

void describe_scene_file(KeyVisitor& visitor, SceneFile& scene) {
  describe_scene(visitor, scene);
  describe_view(visitor, scene.view);
}

}  // namespace sandstroke
