#pragma once

#include "sim/contact_force.h"

namespace sandstroke {

/// A tool of this shape, in sand with this law of force.
inline Scene contact_scene_of(ForceLaw law, ToolShape shape) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 200;
  scene.force.law = law;
  scene.tool.shape = shape;
  return scene;
}

/// The wrench on level sand that is not displaced, after the tool has yielded downwards.
inline Wrench pressed(const Scene& scene, double depth) {
  HeightField bed = starting_bed(scene.bed);
  const std::unique_ptr<ToolForce> law = make_contact_force(scene, bed.cell_size());
  SandSide sand(scene.tool, scene.displacement);
  sand.look(bed, Eigen::Vector3d::Zero());
  const Eigen::Vector3d tip(0.0, 0.0, -depth - sand.tool().lowest());
  return law->in_tick(sand, bed, tip, {0.0, 0.0, -2.0 * scene.strength.yield_way}, true);
}

}  // namespace sandstroke
