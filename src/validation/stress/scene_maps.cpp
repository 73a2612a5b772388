// Maps about a scene's own loop.
#include <algorithm>
#include <cmath>

#include "core/interrupt.h"
#include "validation/stress/device_parts.h"
#include "validation/stress/loop_margins.h"
#include "validation/stress/loop_theory.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

/// About a value, or from 0.1 to 1000 if it is 0.
MapAxis about(const char* name, const char* unit, double value, double below, double above, int count) {
  const bool known = value > 0.0;
  return map_axis(name, unit, AxisScale::logarithmic, known ? value / below : 0.1,
                  known ? value * above : 1e3, count);
}

/// The loop with sand that is felt as stiff as K [N/m], pressed with the same force.
LoopSettings of_stiffness(const LoopSettings& own, double K) {
  const auto* sand = std::get_if<PressedSand>(&own.against);
  if (!sand) return with_gain(own, K / felt_about_rest(own).z.stiffness);
  return pressed_into(K, repulse_force(sand->depth, sand->force), own.device, sand->force);
}

std::vector<LoopMapPlan> plans_about(const LoopSettings& own, bool quick) {
  const int cols = quick ? 8 : 24, rows = quick ? 7 : 20;
  const DeviceSettings& device = own.device;
  const double stiffness = felt_about_rest(own).z.stiffness;
  const double gain = std::clamp(exact_boundary_gain(own), 0.01, 1000.0);
  double softest = stiffness / (10.0 * std::max(1.0, 1.0 / gain));
  if (const auto* sand = std::get_if<PressedSand>(&own.against))  // at which k_s would be 0
    softest =
        std::max(softest, 1.05 * device.scale * sand->force.k_c * repulse_force(sand->depth, sand->force));
  const MapAxis stiffnesses = map_axis("stiffness", "N/m", AxisScale::logarithmic, softest,
                                       10.0 * std::max(1.0, gain) * stiffness, rows);
  const char* const text = "All other settings are the scene's.";
  struct Setting {
    const char *name, *unit;
    double DeviceSettings::*value;
  };
  const auto over = [&](const char* name, const char* title, const Setting& x, const Setting& y) {
    return map_by_eigenvalue(name, title, text, about(x.name, x.unit, device.*x.value, 30.0, 30.0, cols),
                             about(y.name, y.unit, device.*y.value, 30.0, 30.0, rows),
                             [own, x, y](double at_x, double at_y) {
                               LoopSettings loop = own;
                               loop.device.*x.value = at_x;
                               loop.device.*y.value = at_y;
                               return loop;
                             });
  };
  std::vector<LoopMapPlan> plans{
      map_by_eigenvalue("scene-rate-stiffness", "Servo rate and stiffness of the sand", text,
                        about("servo rate", "Hz", device.servo_rate, 50.0, 10.0, cols), stiffnesses,
                        [=](double rate, double K) {
                          LoopSettings loop = of_stiffness(own, K);
                          loop.device.servo_rate = rate;
                          return loop;
                        }),
      map_by_eigenvalue("scene-delay-stiffness", "Delay and stiffness of the sand", text,
                        map_axis("delay", "ticks", AxisScale::linear, 0.0,
                                 std::clamp(2 * device.delay, 20, latest_judged), quick ? 6 : 21),
                        stiffnesses,
                        [=](double delay, double K) {
                          LoopSettings loop = of_stiffness(own, K);
                          loop.device.delay = static_cast<int>(std::lround(delay));
                          return loop;
                        }),
      over("scene-mass-damping", "Mass and damping of the device", {"mass", "kg", &DeviceSettings::mass},
           {"damping", "N s/m", &DeviceSettings::damping}),
      over("scene-hand", "Stiffness and damping of the hand",
           {"hand stiffness", "N/m", &DeviceSettings::hand_stiffness},
           {"hand damping", "N s/m", &DeviceSettings::hand_damping})};
  for (LoopMapPlan& plan : plans) plan.marked = {{"this scene", own}};
  return plans;
}

}  // namespace

StressReport stress_scene(const LoopSettings& own, const StressOptions& options) {
  StressReport report;
  report.margins.push_back(margins_of("this scene", own));
  const std::vector<LoopMapPlan> plans = plans_about(own, options.quick);
  for (const LoopMapPlan& plan : plans) {
    if (interrupted()) break;
    report.maps.push_back(draw_map(plan));
    options.progress(static_cast<double>(report.maps.size()) / static_cast<double>(plans.size()));
  }
  return report;
}

}  // namespace sandstroke
