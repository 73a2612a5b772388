#include "play.h"

#include <algorithm>
#include <cmath>

#include "fuzz.h"
#include "haptics/stroke_placement.h"
#include "haptics/stroke_sampler.h"
#include "sand/initial_surface.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

constexpr int few_cells = 64, few_ticks = 8;

void run_briefly(Scene scene, const std::optional<Stroke>& stroke) {
  scene.relaxation.max_passes = std::min<std::int64_t>(scene.relaxation.max_passes, 2);
  scene.output.frames = 0.0;
  if (scene.ground.has_mesh() || scene.ground.map) return;
  Simulation(scene, on_ground(starting_bed(scene.bed), scene), stroke).run();
}

}  // namespace

Scene small_scene() {
  Scene scene;
  scene.bed.cols = scene.bed.rows = few_cells;
  scene.tool.radius = 0.1;
  return scene;
}

void play(const Stroke& stroke) {
  StrokePlacement placement;
  placement.rotate_z = 30.0;
  placement.scale = 2.0;
  placement.offset = {0.1, -0.2, 0.01};
  for (const StrokePlane plane : {StrokePlane::fit, StrokePlane::keep})
    try_input([&] {
      placement.plane = plane;
      StrokeSampler sampler(place_stroke(stroke, placement));
      const double begin = sampler.start_time(), length = sampler.end_time() - begin;
      constexpr int instants = 64;
      for (int i = -1; i <= instants + 1; ++i) {
        const double time = begin + length * i / instants;
        const Hand hand = sampler.at(time);
        if (std::isfinite(time)) require(hand.position.allFinite());
        sampler.lifts_between(time, time + length / instants);
      }
    });
  try_input([&] {
    const Scene scene = small_scene();
    placement.stop = few_ticks / scene.device.servo_rate;
    run_briefly(scene, place_stroke(stroke, placement));
  });
}

void play(Scene scene) {
  if (std::max(scene.bed.cols, scene.bed.rows) > few_cells) return;
  std::optional<Stroke> stroke;
  if (scene.stroke) {
    stroke.emplace();
    for (int i = 0; i < few_ticks; ++i) {
      stroke->time.push_back(i / scene.device.servo_rate);
      stroke->position.emplace_back(0.3 * scene.tool.radius * i, 0.0, 0.1 * scene.tool.radius * (3 - i));
    }
    stroke->gap_threshold = 2.0 / scene.device.servo_rate;
    stroke = place_stroke(*stroke, scene.stroke->placement);
  }
  run_briefly(std::move(scene), stroke);
}

}  // namespace sandstroke
