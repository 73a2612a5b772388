#include "validation/study/contact_scene.h"

#include <algorithm>

namespace sandstroke {

Scene contact_scene(double width, int cells, double servo_rate) {
  Scene scene;
  scene.bed.width = scene.bed.depth = width;
  scene.bed.cols = scene.bed.rows = cells;
  scene.device.servo_rate = servo_rate;
  scene.device.max_force = 0.0;
  scene.relaxation.rate = 0.0;
  scene.output.trace = false;
  return scene;
}

Scene solid_contact_scene(double width, int cells, const ToolSettings& tool) {
  Scene scene = contact_scene(width, cells, 1000.0);
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.relaxation.way = 0.0;
  scene.relaxation.max_passes = 0;
  scene.tool = tool;
  scene.tool.solid = true;
  return scene;
}

Stroke straight(const std::vector<Eigen::Vector3d>& positions, const std::vector<double>& seconds) {
  Stroke stroke;
  stroke.time = {0.0};
  for (const double one : seconds) stroke.time.push_back(stroke.time.back() + one);
  stroke.position = positions;
  stroke.gap_threshold = 2.0 * stroke.time.back();
  return stroke;
}

}  // namespace sandstroke
