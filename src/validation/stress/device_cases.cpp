#include "validation/stress/device_parts.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <functional>

#include "core/bisection.h"
#include "core/error.h"
#include "measure/solution.h"
#include "validation/stress/loop_theory.h"

namespace sandstroke {
namespace {

constexpr double hand_depth = 0.015;                        // m, where the hand wants the tool
constexpr double plunged = 0.4, drawn = 1.2, waited = 2.4;  // s, when each part of the stroke ends
constexpr double rests_within = 1e-3;  // N: a tool at rest feels a force that swings by less, peak to peak

/// The paper's sand on a small bed, and a device with a force limit and exact encoders.
Scene small_scene() {
  Scene scene;
  scene.bed.width = 0.24;
  scene.bed.depth = 0.12;
  scene.bed.cols = 120;
  scene.bed.rows = 60;
  scene.device.model = DeviceModel::dynamic;
  scene.device.resolution = 0.0;
  return scene;
}

/// The stroke, in positions of the device. In the bed it is the same for every scale.
Stroke plunge_draw_and_hold(double scale) {
  Stroke stroke;
  stroke.time = {0.0, plunged, drawn, waited};
  stroke.position = {
      {-0.01, 0.0, 0.005}, {-0.01, 0.0, -hand_depth}, {0.01, 0.0, -hand_depth}, {0.01, 0.0, -hand_depth}};
  for (Eigen::Vector3d& position : stroke.position) position /= scale;
  stroke.gap_threshold = waited;
  return stroke;
}

struct Outcome {
  Verdict verdict = Verdict::diverged;
  std::string detail;
  std::vector<TickRecord> ticks;
};

/// The force's largest swing along any axis [N], peak to peak, between two times [s].
double swing_between(const std::vector<TickRecord>& ticks, double from, double to) {
  Eigen::AlignedBox3d forces;
  for (const TickRecord& tick : ticks)
    if (tick.time >= from && tick.time <= to) forces.extend(tick.device_force);
  return forces.sizes().maxCoeff();
}

Outcome simulate(const Scene& scene) {
  Kept ticks(+[](const TickRecord& tick) { return tick; });
  Outcome outcome;
  try {
    const RunResult result =
        solve(scene, starting_bed(scene.bed), plunge_draw_and_hold(scene.device.scale), {&ticks}).result;
    const DeviceResult& device = result.device;
    // At the end the hand holds the tool. The tool then rests, creeps to rest, or swings.
    const double swing = swing_between(ticks.values, waited - 0.25, waited);
    const bool creeps = swing < 0.7 * swing_between(ticks.values, waited - 0.5, waited - 0.25);
    outcome.verdict = swing < rests_within || creeps ? Verdict::stable : Verdict::limit_cycle;
    outcome.detail = fmt::format(
        "the force swings by {:.3g} N at the end, up to {:.3g} mm deep and {:.3g} N; {:.3g} J into the sand, "
        "{}; "
        "least passivity margin {:.3g} N s/m",
        swing, 1e3 * result.max_depth, device.max_force, device.absorbed_energy,
        loop_returned_energy(device, scene.device)
            ? fmt::format("which returned up to {:.3g} J more than it took", -device.least_absorbed_energy)
            : "which returned no more than it took",
        device.least_passivity_margin);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::unstable) outcome.verdict = Verdict::refused;
    outcome.detail = error.what();
  }
  outcome.ticks = std::move(ticks.values);
  return outcome;
}

/// The loop about the depth where the hand's spring and the sand balance.
LoopSettings about_balance(const Scene& scene) {
  const double scale = scene.device.scale;
  const double rest = boundary_between(0.0, hand_depth, 60, mean, [&](double depth) {
    const double pull = scene.device.hand_stiffness * (hand_depth - depth) / scale;
    return repulse_force(depth, scene.force) < pull;
  });
  LoopSettings loop;
  loop.device = scene.device;
  loop.against = PressedSand{scene.force, rest, 0.0};
  return loop;
}

std::vector<Verdict> expected_of(const Scene& scene) {
  const LoopSettings loop = about_balance(scene);
  const DeviceSettings& device = scene.device;
  const auto ticks = static_cast<std::int64_t>(waited * device.servo_rate);
  if (device.dropped_ticks == 0.0) return expected_verdicts(loop, ticks);
  if (margin_by_age(loop, ticks) > 0.0 && scene.force.k_f == 0.0) return {Verdict::stable};
  return {Verdict::stable, Verdict::limit_cycle, Verdict::diverged};
}

struct Plan {
  const char* name;
  const char* settings;
  std::function<void(Scene&)> set;
};

const Plan plans[] = {
    {"as published", "k_s 1000 N, k_c 0.5 1/m, k_f 10 s/m, 1 kHz", [](Scene&) {}},
    {"without drag", "k_f 0", [](Scene& s) { s.force.k_f = 0.0; }},
    {"a little late", "k_f 0, 10 ticks late",
     [](Scene& s) {
       s.force.k_f = 0.0;
       s.device.delay = 10;
     }},
    {"the paper's late loop", "k_f 0, 40 ticks late",
     [](Scene& s) {
       s.force.k_f = 0.0;
       s.device.delay = 40;
     }},
    {"late drag", "k_f 10 s/m, 20 ticks late", [](Scene& s) { s.device.delay = 20; }},
    {"half of the ticks dropped", "k_f 0, half of the ticks late",
     [](Scene& s) {
       s.force.k_f = 0.0;
       s.device.dropped_ticks = 0.5;
     }},
    {"stiff sand", "k_f 0, k_s 20 kN",
     [](Scene& s) {
       s.force.k_f = 0.0;
       s.force.k_s = 20e3;
     }},
    {"stiff sand, slow loop", "k_f 0, k_s 20 kN, 200 Hz",
     [](Scene& s) {
       s.force.k_f = 0.0;
       s.force.k_s = 20e3;
       s.device.servo_rate = 200.0;
     }},
    {"large workspace", "k_f 0, scale 10",
     [](Scene& s) {
       s.force.k_f = 0.0;
       s.device.scale = 10.0;
     }},
    {"large workspace, slow loop", "k_f 0, scale 10, 100 Hz",
     [](Scene& s) {
       s.force.k_f = 0.0;
       s.device.scale = 10.0;
       s.device.servo_rate = 100.0;
     }},
    {"strong drag, sampled", "k_f 50 s/m, 200 Hz",
     [](Scene& s) {
       s.force.k_f = 50.0;
       s.device.servo_rate = 200.0;
     }},
    {"strong drag, implicit", "k_f 50 s/m, 200 Hz, device.drag = implicit",
     [](Scene& s) {
       s.force.k_f = 50.0;
       s.device.servo_rate = 200.0;
       s.device.drag = DragVelocity::implicit;
     }},
};

Scene scene_of(const Plan& plan) {
  Scene scene = small_scene();
  plan.set(scene);
  return scene;
}

/// Runs each scene and takes one series over time from each.
StressTrace trace_of(const char* name, const char* title, const char* text, const char* y_name, double until,
                     const std::vector<std::pair<std::string, Scene>>& scenes,
                     const std::function<double(const TickRecord&)>& value) {
  StressTrace trace{name, title, text, y_name, {}, {}};
  for (const auto& [series, scene] : scenes) {
    const Outcome outcome = simulate(scene);
    std::vector<double> values;
    for (const TickRecord& tick : outcome.ticks) {
      if (tick.time > until) break;
      if (trace.series.empty()) trace.time.push_back(tick.time);
      values.push_back(value(tick));
    }
    trace.series.emplace_back(series, std::move(values));
  }
  return trace;
}

Scene late_by(int ticks) {
  Scene scene = small_scene();
  scene.force.k_f = 0.0;
  scene.device.delay = ticks;
  return scene;
}

Scene strongly_dragged(DragVelocity velocity) {
  Scene scene = small_scene();
  scene.force.k_f = 50.0;
  scene.device.servo_rate = 200.0;
  scene.device.drag = velocity;
  return scene;
}

}  // namespace

void add_device_cases(StressReport& report) {
  for (const Plan& plan : plans) {
    const Scene scene = scene_of(plan);
    const Outcome outcome = simulate(scene);
    report.cases.push_back({"device loop, whole simulation", plan.name, plan.settings, expected_of(scene),
                            outcome.verdict, outcome.detail});
  }
  report.traces.push_back(
      trace_of("late-loop", "A late loop throws the tool out of the sand",
               "The paper's remark: if the force is late, the tool sinks too deep, is thrown out of the "
               "sand, and falls back. The hand plunges the tool, draws it along and holds it. Without drag.",
               "depth of the tip below the level [mm]", waited,
               {{"on time", late_by(0)}, {"20 ms late", late_by(20)}, {"40 ms late", late_by(40)}},
               [](const TickRecord& tick) { return 1e3 * tick.depth; }));
  report.traces.push_back(trace_of("drag", "Drag by an old velocity and by the velocity in the tick",
                                   "200 Hz and k_f = 50 s/m: sampled drag overshoots within a tick and "
                                   "changes its sign in the next; implicit "
                                   "drag (device.drag) does not.",
                                   "drag on the device [N]", 0.9,
                                   {{"sampled", strongly_dragged(DragVelocity::sampled)},
                                    {"implicit", strongly_dragged(DragVelocity::implicit)}},
                                   [](const TickRecord& tick) { return tick.device_force.x(); }));
}

}  // namespace sandstroke
