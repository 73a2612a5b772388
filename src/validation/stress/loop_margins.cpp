#include "validation/stress/loop_margins.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/bisection.h"
#include "validation/stress/device_parts.h"
#include "validation/stress/loop_theory.h"

namespace sandstroke {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

bool is_stable(const LoopSettings& loop) { return spectral_radius(loop) < 1.0; }

/// A setting that may become so many times smaller. `divide` divides it.
template <class Divide>
Margin smaller(std::string what, std::string unit, double value, const LoopSettings& loop,
               const Divide& divide) {
  const double factor = boundary_of_positive([&](double by) {
    LoopSettings changed = loop;
    divide(changed.device, by);
    return is_stable(changed);
  });
  return {std::move(what), std::move(unit), value, factor > 0.0 ? value / factor : unbounded, factor};
}

/// The most ticks by which the force may be late; the factor counts the tick in which it acts.
Margin late(const LoopSettings& loop) {
  const auto stable_at = [&](int delay) {
    LoopSettings changed = loop;
    changed.device.delay = delay;
    return is_stable(changed);
  };
  const double now = loop.device.delay;
  if (!stable_at(0)) return {"delay of the force", "ticks", now, unbounded, 0.0};
  int low = 0, high = 1;  // stable up to low, not from high on
  while (high < latest_judged && stable_at(high)) {
    low = high;
    high = std::min(2 * high, latest_judged);
  }
  if (high == latest_judged && stable_at(high)) low = high;  // and maybe more
  while (high - low > 1) {
    const int between = (low + high) / 2;
    (stable_at(between) ? low : high) = between;
  }
  return {"delay of the force", "ticks", now, double(low), (1.0 + low) / (1.0 + now)};
}

/// A setting of a loop, as an axis shows it. Empty: the loop does not have it.
std::optional<double> on_axis(const std::string& axis, const LoopSettings& loop) {
  const DeviceSettings& device = loop.device;
  if (axis == "servo rate") return device.servo_rate;
  if (axis == "stiffness") return felt_about_rest(loop).z.stiffness;
  if (axis == "mass") return device.mass;
  if (axis == "damping") return device.damping;
  if (axis == "hand stiffness") return device.hand_stiffness;
  if (axis == "hand damping") return device.hand_damping;
  if (axis == "scale") return device.scale;
  if (axis == "delay") return device.delay;
  if (axis == "dropped ticks") return device.dropped_ticks;
  if (axis == "encoder resolution") return device.resolution;
  if (const auto* sand = std::get_if<PressedSand>(&loop.against)) {
    if (axis == "k_c") return sand->force.k_c;
    if (axis == "k_f") return sand->force.k_f;
    if (axis == "depth") return sand->depth;
    if (axis == "pressing force") return repulse_force(sand->depth, sand->force);
  } else if (const auto* sand_that_yields = std::get_if<YieldingSand>(&loop.against)) {
    if (axis == "yield way") return sand_that_yields->yield;
    if (axis == "strength") return sand_that_yields->strength;
  }
  return std::nullopt;
}

}  // namespace

LoopMargins margins_of(const std::string& name, const LoopSettings& given) {
  LoopSettings loop = given;
  loop.device.resolution = loop.device.dropped_ticks = 0.0;
  const FeltAlong felt = felt_about_rest(loop);
  const DeviceSettings& device = loop.device;
  LoopMargins margins{name, in_words(loop), is_stable(loop), {}};
  const double gain = exact_boundary_gain(loop);
  const double stiffness = felt.z.stiffness;
  margins.margins = {
      {felt.x.damping + felt.z.damping > 0.0 ? "stiffness of the sand, and its drag"
                                             : "stiffness of the sand",
       "N/m", stiffness, gain > 0.0 ? gain * stiffness : unbounded, gain},
      smaller("servo rate", "Hz", device.servo_rate, loop,
              [](DeviceSettings& d, double by) { d.servo_rate /= by; }),
      smaller("damping of device and hand", "N s/m", device.damping + device.hand_damping, loop,
              [](DeviceSettings& d, double by) {
                d.damping /= by;
                d.hand_damping /= by;
              }),
      late(loop)};
  return margins;
}

std::string in_words(const LoopSettings& settings) {
  const DeviceSettings& d = settings.device;
  std::string words =
      fmt::format("{:.0f} Hz, {:.3g} kg, b {:.3g} N s/m, hand {:.3g} N/m and {:.3g} N s/m, delay {}",
                  d.servo_rate, d.mass, d.damping, d.hand_stiffness, d.hand_damping, d.delay);
  const FeltAlong felt = felt_about_rest(settings);
  if (const auto* sand = std::get_if<PressedSand>(&settings.against))
    words += fmt::format(", sand: scale {:.3g}, k_c {:.3g} 1/m, {:.3g} mm deep", d.scale, sand->force.k_c,
                         1e3 * sand->depth);
  else if (const auto* yielding = std::get_if<YieldingSand>(&settings.against))
    words += fmt::format(", sand that yields: scale {:.3g}, {:.3g} N in {:.3g} mm", d.scale,
                         yielding->strength, 1e3 * yielding->yield);
  else
    words += ", wall";
  if (felt.z.damping > 0.0) words += fmt::format(", drag {:.3g} s of K", felt.z.damping / felt.z.stiffness);
  return words;
}

std::vector<MarkedLoop> known_loops() {
  DeviceSettings device;
  device.model = DeviceModel::dynamic;
  const SandStrength sand;
  LoopSettings paper = pressed_with(pressing_force, device, ForceSettings{}), yielding = paper;
  yielding.against = YieldingSand{pressing_force / YieldingSand::fraction_at_rest, sand.yield_way};
  yielding.disturbance = 0.01 * sand.yield_way;
  return {{"the paper's sand, the default", paper}, {"force.law = \"rft\", else the default", yielding}};
}

std::vector<MapMark> marks_in(const MapAxis& x, const MapAxis& y,
                              const std::function<LoopSettings(double x, double y)>& loop,
                              const std::vector<MarkedLoop>& marked) {
  std::vector<MapMark> marks;
  for (const MarkedLoop& one : marked) {
    const std::optional<double> at_x = on_axis(x.name, one.loop), at_y = on_axis(y.name, one.loop);
    if (!at_x || !at_y) continue;
    const LoopSettings there = loop(*at_x, *at_y);
    const double own = spectral_radius(one.loop);
    const bool same =
        there.against.index() == one.loop.against.index() && std::abs(spectral_radius(there) - own) < 1e-9;
    marks.push_back({one.name, *at_x, *at_y, same, own < 1.0});
  }
  return marks;
}

}  // namespace sandstroke
