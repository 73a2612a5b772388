#include "record/felt_loop.h"

#include <algorithm>
#include <cmath>

#include "core/bisection.h"
#include "haptics/loop_stability.h"
#include "measure/contact_stiffness.h"
#include "record/live_sand.h"

namespace sandstroke {
namespace {

/// Rounds down to two digits.
double rounded_down(double value) {
  if (!(value > 0.0) || std::isinf(value)) return std::max(value, 0.0);
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::floor(value / unit) * unit;
}

/// The sand as the device feels it at the largest force.
FeltSand sand_felt(const Scene& scene, const FeltLoop& loop) {
  const double force = loop.force, scale = loop.scale;
  if (is_contact_law(scene)) return {scale * contact_stiffness(scene, force, loop.turns), 0.0};
  return felt_sand(depth_of_repulse_force(force, scene.force), force, scale, scene.force);
}

ForceSettings settling_force(const FeltLoop& loop, const ForceSettings& force) {
  ForceSettings settling = force;
  if (loop.felt.drag >= loop.stable.drag)
    settling.k_f = rounded_down(loop.stable.drag / (loop.scale * loop.force));
  double stiffness = loop.stable.stiffness;
  if (force.drag == DragDirection::full)
    stiffness = stable_sand(loop.device, force.drag, settling.k_f * loop.scale * loop.force,
                            LiveSand::velocity_window)
                    .stiffness;
  if (loop.felt.stiffness < stiffness) return settling;
  // K = scale k_c (k_s + F)
  settling.k_s = rounded_down(stiffness / (loop.scale * force.k_c) - loop.force);
  if (settling.k_s > 0.0) return settling;
  settling.k_s = force.k_s;
  settling.k_c = rounded_down(stiffness / (loop.scale * (force.k_s + loop.force)));
  return settling;
}

/// The least force.yield of two digits that settles [m].
std::optional<double> settling_yield(const FeltLoop& loop, Scene scene) {
  const auto shakes = [&](double yield) {
    scene.strength.yield_way = yield;
    return sand_felt(scene, loop).stiffness >= loop.stable.stiffness;
  };
  double low = scene.strength.yield_way, high = 2.0 * low;
  constexpr double longest = 1.0;  // m, the key's highest value
  for (; high <= longest && shakes(high); high *= 2.0) low = high;
  if (high > longest) return std::nullopt;
  constexpr int halvings = 8;
  low = boundary_between(low, high, halvings, mean, shakes);
  const double unit = std::pow(10.0, std::floor(std::log10(low)) - 1.0);
  double yield = std::ceil(low / unit) * unit;
  while (shakes(yield)) yield += unit;
  return yield;
}

}  // namespace

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
  if (!is_contact_law(scene) && (scene.force.k_s <= 0.0 || scene.force.k_c <= 0.0)) return std::nullopt;
  loop.scale = scene.device.scale * (scene.stroke ? scene.stroke->placement.scale : 1.0);
  loop.turns = device.measures_orientation;
  loop.device = scene.device;
  loop.device.servo_rate = servo_rate;
  constexpr double longest = 100.0;  // ticks, for a map of moderate size; a later loop is not fit to record
  loop.device.delay =
      static_cast<int>(std::clamp(std::ceil(lateness.value_or(0.0) * servo_rate), 1.0, longest));
  loop.felt = sand_felt(scene, loop);
  loop.named = {device.max_stiffness, device.max_damping};
  loop.stable = stable_sand(loop.device, scene.force.drag, loop.felt.drag, LiveSand::velocity_window);
  return loop;
}

std::optional<Scene> settling_scene(const FeltLoop& loop, const Scene& scene) {
  Scene settling = scene;
  if (!is_contact_law(scene)) {
    settling.force = settling_force(loop, scene.force);
  } else if (!loop.is_stable()) {
    const std::optional<double> yield = settling_yield(loop, scene);
    if (!yield) return std::nullopt;
    settling.strength.yield_way = *yield;
  }
  return settling;
}

}  // namespace sandstroke
