#include "io/scene_keys.h"

namespace sandstroke {

std::vector<KeySection> scene_settings(const SceneFile& scene) {
  SceneFile copy = scene;  // a visitor could change it; this one does not
  return listed_keys([&](KeyVisitor& visitor) { describe_scene_file(visitor, copy); });
}

std::vector<KeySection> all_scene_keys() {
  std::vector<KeySection> sections = all_keys([](KeyVisitor& visitor) {
    SceneFile scene;
    scene.stroke.emplace().table.emplace();
    scene.ground.map.emplace();
    scene.ground.regions.emplace_back().k_s = 0.0;
    scene.ground.layers.emplace_back();
    scene.ground.stones.emplace_back();
    scene.moisture.emplace();
    scene.sources.emplace_back();
    describe_scene_file(visitor, scene);
  });
  // With a source, which is there to be listed, it always applies.
  for (KeySection& section : sections)
    for (KeyRow& key : section.keys)
      if (key.name == "force.density") key.condition = "force.law is rft or archimedes";
  return sections;
}

std::string setting_unit(const SceneFile& scene, const std::string& name) {
  for (const KeySection& section : scene_settings(scene))
    for (const KeyRow& key : section.keys)
      if (key.name == name) return key.unit;
  return {};
}

}  // namespace sandstroke
