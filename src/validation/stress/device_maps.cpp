#include "validation/stress/device_parts.h"

#include <algorithm>
#include <cmath>

#include "validation/stress/loop_theory.h"

namespace sandstroke {

LoopSettings pressed_to(double depth, const DeviceSettings& device, const ForceSettings& force) {
  LoopSettings loop;
  loop.device = device;
  loop.against = PressedSand{force, depth, 0.0};
  loop.disturbance = 0.01 * std::min(depth, 1.0 / force.k_c) / device.scale;
  return loop;
}

LoopSettings pressed_with(double newton, const DeviceSettings& device, const ForceSettings& force) {
  return pressed_to(depth_of_repulse_force(newton, force), device, force);
}

LoopSettings pressed_into(double K, double newton, const DeviceSettings& device, ForceSettings force) {
  force.k_s = K / (device.scale * force.k_c) - newton;  // K = scale k_c (k_s + F_r)
  return pressed_with(newton, device, force);
}

namespace {

constexpr const char* eigenvalue = "eigenvalue of the exact tick leaves the unit circle";
constexpr const char* passive = "Colgate & Schenkel: b = K (T/2 + delay) + |B|";

bool differs_from_eigenvalue(const LoopSettings& loop, const LoopRun& run, std::int64_t ticks) {
  return !is_among(run.verdict, expected_verdicts(loop, ticks));
}

double beyond_unit_circle(const LoopSettings& loop) { return spectral_radius(loop) - 1.0; }

}  // namespace

LoopMapPlan map_by_eigenvalue(std::string name, std::string title, std::string text, MapAxis x, MapAxis y,
                              std::function<LoopSettings(double, double)> loop) {
  return {std::move(name),
          std::move(title),
          std::move(text),
          std::move(x),
          std::move(y),
          std::move(loop),
          ticks_to_decide,
          differs_from_eigenvalue,
          {{eigenvalue, beyond_unit_circle},
           {passive, [](const LoopSettings& at) { return passivity_margin(at); }}}};
}

namespace {

constexpr double force_limit = 12.0;  // N, of the paper's omega3

DeviceSettings limited_device() {
  DeviceSettings device = ideal_device();
  device.max_force = force_limit;
  return device;
}

/// The loop in sand without drag. Under the pressing force the device feels the stiffness K.
LoopSettings sand_of_stiffness(double K, const DeviceSettings& device) {
  ForceSettings force;
  force.k_f = 0.0;
  return pressed_into(K, pressing_force, device, force);
}

/// The map with dropped ticks. Random products of exact tick maps decide, as an eigenvalue does without
/// drops. Where the dampers take all energy that the oldest force can return, the loop must be stable.
LoopMapPlan dropped_ticks(const MapAxis& x, const MapAxis& stiffness) {
  LoopMapPlan map = map_by_eigenvalue(
      "dropped-stiffness", "Dropped ticks and stiffness",
      "A two-sided wall at 1 kHz, and a loop that drops a fraction of its ticks: there the last force stays, "
      "which works like a delay. The expected verdicts come from random products of the two exact tick maps.",
      x, stiffness, [](double fraction, double K) {
        LoopSettings loop;
        loop.device = ideal_device();
        loop.device.dropped_ticks = fraction;
        loop.against = Wall{K, 0.0};
        return loop;
      });
  constexpr std::int64_t all_ticks = 20'000;
  map.ticks = [](const LoopSettings&) { return all_ticks; };
  map.surprising = [](const LoopSettings& loop, const LoopRun& run, std::int64_t ticks) {
    return (margin_by_age(loop, ticks) > 0.0 && run.verdict != Verdict::stable) ||
           differs_from_eigenvalue(loop, run, ticks);
  };
  map.curves = {{"random products of exact ticks neither grow nor shrink",
                 [](const LoopSettings& at) { return mean_growth_with_drops(at) - 1.0; }},
                {"b = K x age of the oldest force",
                 [](const LoopSettings& at) { return margin_by_age(at, all_ticks); }}};
  return map;
}

/// The map with encoders. A loop that settles dithers at most as much as their rounding can cause.
LoopMapPlan encoder_steps(const MapAxis& x, const MapAxis& stiffness) {
  LoopMapPlan map =
      map_by_eigenvalue("encoder-stiffness", "Encoder resolution and stiffness",
                        "Sand under 3 N at 1 kHz, 12 N at most. Rounded positions make a loop dither that "
                        "would settle: within one "
                        "encoder step it counts as stable, else as a limit cycle, which is expected only "
                        "where rounding, at most "
                        "half a step either way, can cause as much. The dither grows with the step, so the "
                        "boundary stays.",
                        x, stiffness, [](double resolution, double K) {
                          DeviceSettings device = limited_device();
                          device.resolution = resolution;
                          LoopSettings loop = sand_of_stiffness(K, device);
                          loop.disturbance = std::max(loop.disturbance, 3.0 * resolution);
                          return loop;
                        });
  const auto dither = [](const LoopSettings& loop) {
    return swing_of_encoders(loop) - loop.device.resolution;
  };
  map.surprising = [](const LoopSettings& loop, const LoopRun& run, std::int64_t ticks) {
    const bool settles = expected_verdicts(loop, ticks) == std::vector{Verdict::stable};
    if (!settles) return run.verdict == Verdict::diverged;
    const double most = swing_of_encoders(loop);
    const double depth = std::get<PressedSand>(loop.against).depth;
    if (2.0 * most > depth) return run.verdict == Verdict::diverged;  // the tool may leave the sand
    return run.swing > std::max(most, 0.02 * loop.disturbance);
  };
  map.curves.insert(map.curves.begin() + 1, {"rounding can cause a swing of one step", dither});
  return map;
}

/// The map of a device drawn at 0.1 m/s through the paper's sand.
LoopMapPlan drag(DragVelocity velocity, const MapAxis& k_f, const MapAxis& force) {
  const bool implicit = velocity == DragVelocity::implicit;
  return map_by_eigenvalue(
      implicit ? "drag-implicit" : "drag-sampled",
      implicit ? "Drag by the velocity in the tick" : "Drag by the velocity read before the tick",
      implicit ? "The same with device.drag = \"implicit\": drag can only take energy, and nothing "
                 "is unstable."
               : "Drawn along at 0.1 m/s at 1 kHz, no force limit. Drag is velocity times force, and a "
                 "velocity that is a tick old throws the device back faster than it came where B = k_f "
                 "|F_r| s (s: device.scale) is above about 2 m / T.",
      k_f, force, [velocity](double drag_constant, double newton) {
        DeviceSettings device = ideal_device();
        device.drag = velocity;
        ForceSettings sand;
        sand.k_f = drag_constant;
        LoopSettings loop = pressed_with(newton, device, sand);
        std::get<PressedSand>(loop.against).speed = 0.1;
        return loop;
      });
}

LoopMapPlan wall_plan(const MapAxis& rate, const MapAxis& stiffness) {
  return map_by_eigenvalue(
      "wall-rate-stiffness", "A two-sided wall: servo rate and stiffness",
      "The default device (0.25 kg, 9 N s/m with the hand's) against a spring that also pulls: loops "
      "that are not stable diverge.",
      rate, stiffness, [](double servo_rate, double K) {
        LoopSettings loop;
        loop.device = ideal_device();
        loop.device.servo_rate = servo_rate;
        loop.against = Wall{K, 0.0};
        return loop;
      });
}

LoopMapPlan hand_plan(const MapAxis& stiffness, const MapAxis& damping) {
  return map_by_eigenvalue(
      "hand", "The hand's stiffness and damping",
      "Sand of 2 kN/m under 3 N at 100 Hz, 12 N at most, the device's own damping 1 N s/m: the damping "
      "decides, and stiffness helps only where the hand is stiffer than the sand.",
      stiffness, damping, [](double stiffness_of_hand, double damping_of_hand) {
        DeviceSettings device = limited_device();
        device.servo_rate = 100.0;
        device.hand_stiffness = stiffness_of_hand;
        device.hand_damping = damping_of_hand;
        return sand_of_stiffness(2e3, device);
      });
}

LoopMapPlan depth_plan(const MapAxis& k_c, const MapAxis& depths) {
  return map_by_eigenvalue(
      "depth", "Growth of the force (k_c) and depth",
      "k_s = 10 N at 1 kHz, no force limit. An exponential law is soft at the top and stiff below, "
      "so the loop is stable down to some depth.",
      k_c, depths, [](double growth, double depth_of_tip) {
        ForceSettings force;
        force.k_s = 10.0;
        force.k_c = growth;
        force.k_f = 0.0;
        return pressed_to(depth_of_tip, ideal_device(), force);
      });
}

LoopMapPlan yield_plan(const MapAxis& yield, const MapAxis& strength) {
  return map_by_eigenvalue(
      "rft-yield-strength", "Resistive force theory: yield way and strength",
      "force.law = \"rft\" at 1 kHz: the force turns round within force.yield, as a spring of strength / "
      "yield. What is too stiff swings by little more than the yield way, or comes to rest where the sand "
      "has yielded, and never diverges.",
      yield, strength, [](double way, double newton) {
        LoopSettings loop;
        loop.device = ideal_device();
        loop.against = YieldingSand{newton, way};
        loop.disturbance = 0.01 * way;
        return loop;
      });
}

}  // namespace

std::vector<LoopMapPlan> device_map_plans(bool quick) {
  const int cols = quick ? 8 : 24, rows = quick ? 7 : 20;
  const auto x = [&](const char* name, const char* unit, double low, double high) {
    return map_axis(name, unit, AxisScale::logarithmic, low, high, cols);
  };
  const auto y = [&](const char* name, const char* unit, double low, double high) {
    return map_axis(name, unit, AxisScale::logarithmic, low, high, rows);
  };
  const MapAxis servo_rate = x("servo rate", "Hz", 50.0, 20e3), stiffness = y("stiffness", "N/m", 100.0, 1e6);
  return {
      wall_plan(servo_rate, stiffness),
      map_by_eigenvalue(
          "sand-rate-stiffness", "Sand: servo rate and stiffness (k_s)",
          "The same device pressed with 3 N into sand, which only pushes, without a force limit. Beyond the "
          "boundary it bounces, and far beyond it bounces higher each time. Theory does not tell the two "
          "apart.",
          servo_rate, stiffness,
          [](double rate, double K) {
            DeviceSettings device = ideal_device();
            device.servo_rate = rate;
            return sand_of_stiffness(K, device);
          }),
      map_by_eigenvalue(
          "mass-damping", "Mass and damping of the device",
          "Sand of 20 kN/m under 3 N at 1 kHz, 12 N at most, the hand without damping. Stable from b = K T/2 "
          "on, whatever the mass; a light device gets by with a little less.",
          x("mass", "kg", 0.01, 10.0), y("damping", "N s/m", 0.1, 100.0),
          [](double mass, double damping) {
            DeviceSettings device = limited_device();
            device.mass = mass;
            device.damping = damping;
            device.hand_damping = 0.0;
            return sand_of_stiffness(20e3, device);
          }),
      hand_plan(x("hand stiffness", "N/m", 10.0, 1e4), y("hand damping", "N s/m", 0.1, 100.0)),
      map_by_eigenvalue(
          "rate-scale", "Servo rate and workspace scale",
          "The paper's constants (k_s 1000 N, k_c 0.5 1/m, k_f 10 s/m) under 3 N, 12 N at most: what a "
          "device metre is in the bed multiplies both stiffness and drag.",
          servo_rate, y("scale", "", 0.1, 1000.0),
          [](double rate, double scale) {
            DeviceSettings device = limited_device();
            device.servo_rate = rate;
            device.scale = scale;
            return pressed_with(pressing_force, device, ForceSettings{});
          }),
      map_by_eigenvalue("delay-stiffness", "Delay and stiffness",
                        "Sand under 3 N at 1 kHz, 12 N at most, whose force acts some ticks late.",
                        map_axis("delay", "ticks", AxisScale::linear, 0.0, 20.0, quick ? 6 : 21), stiffness,
                        [](double delay, double K) {
                          DeviceSettings device = limited_device();
                          device.delay = static_cast<int>(std::lround(delay));
                          return sand_of_stiffness(K, device);
                        }),
      dropped_ticks(map_axis("dropped ticks", "", AxisScale::linear, 0.0, 0.9, quick ? 7 : 19), stiffness),
      encoder_steps(x("encoder resolution", "m", 1e-7, 1e-3), stiffness),
      yield_plan(x("yield way", "m", 1e-5, 1e-2), y("strength", "N", 0.1, 100.0)),
      depth_plan(x("k_c", "1/m", 10.0, 400.0), y("depth", "m", 5e-4, 0.05)),
      drag(DragVelocity::sampled, x("k_f", "s/m", 1.0, 1e5), y("pressing force", "N", 0.1, 20.0)),
      drag(DragVelocity::implicit, x("k_f", "s/m", 1.0, 1e5), y("pressing force", "N", 0.1, 20.0)),
  };
}

}  // namespace sandstroke
