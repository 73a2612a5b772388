// Tools that hit stones: at any speed, from any side, or from within. The run ends, forces are numbers, and
// up to the bound of passivity a dynamic device gets no energy from a stone.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "haptics/passivity.h"
#include "validation/stress/hostile_grounds.h"
#include "validation/stress/judged_run.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

/// On a bed of 0.2 m, level at 0, with stones and a floor at -20 mm.
struct Hit {
  const char *name, *settings;
  std::function<Eigen::Vector3d(double time)> at;  // m, s
};

std::vector<Hit> hits() {
  using H = Eigen::Vector3d;
  return {
      {"onto a ball at 100 m/s", "1 m down through it within 10 ms",
       [](double t) { return H(0.0, 0.0, std::max(0.1 - 100.0 * t, -0.9)); }},
      {"onto a ball at 2 m/s", "to 40 mm below its top",
       [](double t) { return H(0.003, 0.002, std::max(0.05 - 2.0 * t, -0.03)); }},
      {"drums on a ball", "at 250 Hz, between 10 mm above and below its top",
       [](double t) { return H(0.004, 0.0, 0.01 + (std::llround(1000.0 * t) / 2 % 2 ? -0.01 : 0.01)); }},
      {"against a wall at 20 m/s", "from 80 mm beside an upright box into it",
       [](double t) { return H(std::min(-0.08 + 20.0 * t, 0.06), 0.05, -0.005); }},
      {"into a corner", "between a box and a ball, down and sideways at 1 m/s",
       [](double t) { return H(0.02, 0.05 - std::min(t, 0.05), 0.02 - std::min(t, 0.06)); }},
      {"starts in a stone", "10 mm deep, and leaves it at 1 m/s",
       [](double t) { return H(std::min(t, 0.08), 0.0, 0.0); }},
      {"along a needle", "a box of 1 um, at 0.2 m/s",
       [](double t) { return H(-0.06 + 0.2 * t, -0.05, -0.01); }},
      {"onto the floor at 5 m/s", "to 1 m below it",
       [](double t) { return H(-0.05, -0.05, std::max(0.1 - 5.0 * t, -1.0)); }},
  };
}

Stroke stroke_into(const Hit& hit, int ticks) {
  Stroke stroke;
  for (int i = 0; i <= ticks; ++i) {
    stroke.time.push_back(0.001 * i);
    stroke.position.push_back(hit.at(0.001 * i));
  }
  return stroke;
}

Scene bed_of_stones(bool sand) {
  using H = Eigen::Vector3d;
  Scene scene;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 100;
  scene.ground.floor = sand ? -0.02 : 0.0;
  scene.ground.stones = {
      stone_of(StoneShape::sphere, H(0.0, 0.0, -0.01), H::Constant(0.04)),
      stone_of(StoneShape::box, H(0.03, 0.05, 0.0), H(0.04, 0.04, 0.06)),
      stone_of(StoneShape::box, H(-0.03, -0.05, 0.0), H(1e-6, 0.02, 0.06)),
  };
  scene.stroke.emplace().file = "in memory";
  scene.output.trace = false;
  return scene;
}

StressCase hit_stones(const Hit& hit, bool quick) {
  Variations all("stones", hit.name, hit.settings, {Verdict::stable});
  const std::vector<ToolShape> shapes = quick
                                            ? std::vector{ToolShape::sphere, ToolShape::box}
                                            : std::vector{ToolShape::sphere, ToolShape::cylinder,
                                                          ToolShape::cone, ToolShape::box, ToolShape::plate};
  for (const ToolShape shape : shapes)
    for (const DeviceModel model : {DeviceModel::kinematic, DeviceModel::dynamic})
      for (const bool sand : {true, false}) {
        if (quick && (model == DeviceModel::kinematic || sand != (shape == ToolShape::sphere))) continue;
        Scene scene = bed_of_stones(sand);
        scene.tool.shape = shape;
        scene.tool.width = 0.05;
        scene.tool.thickness = 0.01;
        DeviceSettings& device = scene.device;
        device.model = model;
        if (!sand) device.max_force = 0.0;
        // Just below the bound of passivity.
        scene.ground.stiffness = 0.999 * 2.0 * device.servo_rate * passivity_margin(0.0, 0.0, device);
        all.add(judged_on_threads(scene, starting_bed(scene.bed), stroke_into(hit, quick ? 100 : 300)),
                fmt::format("tool.shape {}, {}, {}", static_cast<int>(shape),
                            model == DeviceModel::dynamic ? "dynamic" : "kinematic",
                            sand ? "in sand" : "bare stones, no limit of force"));
      }
  return all.done();
}

/// Beyond the bound of passivity, a dynamic device is refused.
StressCase too_stiff() {
  Variations all("stones", "too stiff", "just beyond the bound of passivity, and 1e300 N/m",
                 {Verdict::refused});
  for (const int delay : {0, 3})
    for (const double part : {1.001, 1e300}) {
      Scene scene = bed_of_stones(true);
      scene.device.model = DeviceModel::dynamic;
      scene.device.delay = delay;
      scene.ground.stiffness = std::min(
          1e300, part * scene.device.servo_rate * passivity_margin(0.0, 0.0, scene.device) / (0.5 + delay));
      all.add(judged_run(scene, starting_bed(scene.bed), stroke_into(hits().front(), 10)),
              fmt::format("{} N/m, {} ticks late", scene.ground.stiffness, delay));
    }
  return all.done();
}

}  // namespace

void stress_stone_strokes(StressReport& report, const StressOptions& options) {
  const std::vector<Hit> all = hits();
  double done = 0.0;
  for (const Hit& hit : all) {
    report.cases.push_back(hit_stones(hit, options.quick));
    options.progress(done += 0.9 / static_cast<double>(all.size()));
  }
  report.cases.push_back(too_stiff());
  options.progress(1.0);
}

}  // namespace sandstroke
