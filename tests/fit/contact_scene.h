#pragma once

#include "sim/scene.h"

namespace sandstroke {

/// A small bed, and a tool whose force comes from the contact, by this law.
inline Scene scene_with(ForceLaw law, ToolShape shape) {
  Scene scene;
  scene.bed.width = 0.16;
  scene.bed.depth = 0.12;
  scene.bed.cols = 80;
  scene.bed.rows = 60;
  apply_model_preset(scene);
  scene.force.law = law;
  scene.tool.shape = shape;
  if (shape == ToolShape::sphere) scene.tool.profile = ToolProfile::sphere;
  scene.tool.width = 0.03;
  scene.tool.solid = true;
  scene.displacement.deposit = Deposit::outward;
  scene.device.servo_rate = 500.0;
  scene.device.max_force = 0.0;
  return scene;
}

}  // namespace sandstroke
