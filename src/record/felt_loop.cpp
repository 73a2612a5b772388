#include "record/felt_loop.h"

#include <algorithm>
#include <cmath>

#include "haptics/loop_stability.h"
#include "record/live_sand.h"
#include "record/loop_sand.h"

namespace sandstroke {

double largest_force(const Scene& scene, const DeviceSpecification& device, double max_force) {
  const double force = std::min(max_force, device.max_force);
  return scene.device.max_force > 0.0 ? std::min(force, scene.device.max_force) : force;
}

std::optional<FeltLoop> felt_loop(const Scene& scene, const DeviceSpecification& device, double max_force,
                                  double servo_rate, std::optional<double> lateness) {
  if (device.max_force == any_force) return std::nullopt;  // a stand-in that feels none
  FeltLoop loop;
  loop.force = largest_force(scene, device, max_force);
  if (loop.force <= 0.0 || loop.force >= any_force) return std::nullopt;
  loop.scale = scene.device.scale * (scene.stroke ? scene.stroke->placement.scale : 1.0);
  loop.turns = device.measures_orientation;
  const std::unique_ptr<LoopSand> sand = make_loop_sand(scene, loop.scale, loop.turns);
  if (!sand->resists()) return std::nullopt;
  loop.device = scene.device;
  loop.device.servo_rate = servo_rate;
  constexpr double longest = 100.0;  // ticks, for a map of moderate size; a later loop is not fit to record
  loop.device.delay =
      static_cast<int>(std::clamp(std::ceil(lateness.value_or(0.0) * servo_rate), 1.0, longest));
  loop.felt = sand->at(loop.force);
  loop.named = {device.max_stiffness, device.max_damping};
  loop.stable = stable_sand(loop.device, scene.force.drag, loop.felt.drag, LiveSand::velocity_window);
  return loop;
}

std::optional<Scene> settling_scene(const FeltLoop& loop, const Scene& scene) {
  return make_loop_sand(scene, loop.scale, loop.turns)->settling(loop);
}

}  // namespace sandstroke
