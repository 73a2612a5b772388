#pragma once

#include "sim/scene.h"

namespace sandstroke {

/// 1 m x 1 m in cells of 1 cm, without a ground.
inline Scene small_garden() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 1.0;
  scene.bed.cols = scene.bed.rows = 100;
  scene.tool.radius = 0.03;
  return scene;
}

inline StoneSettings sphere(double x, double y, double z, double radius) {
  StoneSettings stone;
  stone.centre = {x, y, z};
  stone.radius = radius;
  return stone;
}

/// Of flatter sand, in the bed's middle.
inline SandRegion flat_region() {
  SandRegion region;
  region.talus_angle = 25.0;
  return region;
}

}  // namespace sandstroke
