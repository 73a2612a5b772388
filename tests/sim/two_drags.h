#pragma once

#include "haptics/stroke.h"
#include "sim/scene.h"

namespace sandstroke {

/// Whether the lifted hand is sampled in a pause, on its straight way: the motion is the same, but no tick is
/// idle.
enum class Pause { unsampled, sampled };

/// Two drags of about 0.3 s through the sand, with a pause of this length [s] between them.
inline Stroke two_drags(double apart, Pause pause) {
  Stroke stroke;
  const auto add = [&](double time, const Eigen::Vector3d& position, PenState pen) {
    stroke.time.push_back(time);
    stroke.position.push_back(position);
    stroke.contact.push_back(pen);
  };
  const Eigen::Vector3d left(-0.04, 0.0, -0.006), right(0.03, 0.01, -0.004);
  const double lifts = 7.3005, lands = lifts + apart;
  for (int i = 0; i <= 6; ++i)
    add(7.0 + i * (lifts - 7.0) / 6, left + 0.01 * i * Eigen::Vector3d::UnitX(), pen_down);
  if (pause == Pause::sampled)
    for (int i = 1; i < 64; ++i)
      add(lifts + i * apart / 64, stroke.position[6] + i / 64.0 * (right - stroke.position[6]), pen_up);
  for (int i = 0; i <= 6; ++i) add(lands + 0.05 * i, right - 0.01 * i * Eigen::Vector3d::UnitX(), pen_down);
  return stroke;
}

/// A bed on which they fit.
inline Scene bed_of_two_drags() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 64;
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  return scene;
}

}  // namespace sandstroke
