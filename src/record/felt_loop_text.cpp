#include "record/felt_loop_text.h"

#include <spdlog/spdlog.h>

#include "core/error.h"
#include "record/loop_sand.h"

namespace sandstroke {
namespace {

/// "set force.k_f = 9.4"
std::string remedy_text(const FeltLoop& loop, const Scene& scene) {
  const std::optional<Scene> settling = settling_scene(loop, scene);
  if (!settling) return "use a smaller tool";
  std::string text = "set ";
  const auto say = [&text](const char* key, double value, double before) {
    if (value != before) text += fmt::format("{}{} = {:.2g}", text.back() == ' ' ? "" : " and ", key, value);
  };
  say("force.k_f", settling->force.k_f, scene.force.k_f);
  say("force.k_s", settling->force.k_s, scene.force.k_s);
  say("force.k_c", settling->force.k_c, scene.force.k_c);
  say("force.yield", settling->strength.yield_way, scene.strength.yield_way);
  return text;
}

}  // namespace

std::string felt_sand_text(const FeltSand& sand) {
  return fmt::format("{:.3g} N/m, {:.3g} N s/m", sand.stiffness, sand.drag);
}

std::string named_text(const FeltSand& named) {
  const auto value = [](double number, const char* unit) {
    return number > 0.0 ? fmt::format("{:.3g} {}", number, unit) : "unknown";
  };
  return value(named.stiffness, "N/m") + ", " + value(named.drag, "N s/m");
}

std::string assumed_text(const DeviceSettings& device) {
  return fmt::format(
      "{:.6g} Hz, force {} {} late, device of {:.3g} kg and {:.3g} N s/m, hand of {:.3g} N/m and "
      "{:.3g} N s/m",
      device.servo_rate, device.delay, device.delay == 1 ? "tick" : "ticks", device.mass, device.damping,
      device.hand_stiffness, device.hand_damping);
}

std::string verdict_text(const FeltLoop& loop, const Scene& scene) {
  if (!loop.is_stable()) return "REFUSED: the hand would shake; " + remedy_text(loop, scene);
  if (!loop.is_within_named()) return "stable in theory, but beyond the limits that the device states";
  if (loop.named.stiffness <= 0.0 || loop.named.drag <= 0.0)
    return "stable in theory; the device does not state all its limits";
  return "stable in theory, and within the limits that the device states";
}

void check_felt_loop(const FeltLoop& loop, const Scene& scene, const std::string& name) {
  if (!loop.is_stable())
    throw_input_error(
        "{}: the hand would shake. On this device the sand has {} at {:.3g} N, but the loop is stable only "
        "up to {} (assuming {}). To avoid this, {} (--set), or lower --max-force; if your device or hand is "
        "different, set device.mass, device.damping, device.hand_stiffness and device.hand_damping",
        name, felt_sand_text(loop.felt), loop.force, felt_sand_text(loop.stable), assumed_text(loop.device),
        remedy_text(loop, scene));
  if (!loop.is_within_named())
    spdlog::warn(
        "{}: the sand has {} at {:.3g} N, but the device states limits of {}. In theory the loop is stable; "
        "if the device buzzes, {}",
        name, felt_sand_text(loop.felt), loop.force, named_text(loop.named),
        make_loop_sand(scene, loop.scale, loop.turns)->remedy());
}

}  // namespace sandstroke
