// Cost of a servo tick without relaxation: the tool's part alone, and whole ticks in sand and in the air.
#include "sim/simulation.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>

#include "sand/sphere_tool.h"

namespace sandstroke {
namespace {

constexpr double dx = 0.002;      // m: the paper's cells, R = 5 of them
constexpr double step = 0.25e-3;  // m per tick: 0.25 m/s at 1 kHz

/// Place, level and both displacement passes, 4 mm deep, back and forth over fresh sand.
void tool_tick(benchmark::State& state, ToolProfile profile, Deposit deposit) {
  ToolSettings sphere;
  sphere.profile = profile;
  const HeightField flat(1000, 1000, dx);
  const DisplacementSettings settings{deposit};
  SphereTool tool(sphere);
  HeightField bed = flat;
  constexpr double margin = 0.9;  // m
  double x = -margin, y = -margin, direction = 1.0;
  for (auto _ : state) {
    x += direction * step;
    tool.place(bed, x, y);
    benchmark::DoNotOptimize(
        tool.displace(bed, tool.sand_level() - 0.004, Eigen::Vector3d(direction * step, 0.0, 0.0), settings));
    if (std::abs(x) < margin) continue;
    direction = -direction;
    y += 0.04;
    if (y < margin) continue;
    state.PauseTiming();
    y = -margin;
    bed = flat;
    state.ResumeTiming();
  }
}
BENCHMARK_CAPTURE(tool_tick, paper_ring, ToolProfile::paper, Deposit::ring)->Name("tool_tick/paper/ring");
BENCHMARK_CAPTURE(tool_tick, paper_ahead, ToolProfile::paper, Deposit::ahead)->Name("tool_tick/paper/ahead");
BENCHMARK_CAPTURE(tool_tick, sphere_ring, ToolProfile::sphere, Deposit::ring)->Name("tool_tick/sphere/ring");
BENCHMARK_CAPTURE(tool_tick, sphere_ahead, ToolProfile::sphere, Deposit::ahead)
    ->Name("tool_tick/sphere/ahead");
BENCHMARK_CAPTURE(tool_tick, sphere_outward, ToolProfile::sphere, Deposit::outward)
    ->Name("tool_tick/sphere/outward");

/// Times the ticks of a run but the first.
class TickClock : public SimulationObserver {
 public:
  void on_progress(double fraction) override {
    if (ticks_++ == 0) begin_ = std::chrono::steady_clock::now();
    if (fraction == 1.0) end_ = std::chrono::steady_clock::now();
  }
  double seconds_per_tick() const {
    return std::chrono::duration<double>(end_ - begin_).count() / static_cast<double>(ticks_ - 1);
  }

 private:
  std::int64_t ticks_ = 0;
  std::chrono::steady_clock::time_point begin_, end_;
};

enum class Tool { in_sand, above, lifted };

/// Eight lines of 1.8 m at 0.25 m/s, over 2 m by 2 m of sand.
void simulation_tick(benchmark::State& state, Scene scene, Tool tool) {
  scene.relaxation.rate = 0.0;
  scene.relaxation.max_passes = 0;
  scene.output.trace = false;
  Stroke stroke;
  const double z = tool == Tool::in_sand ? -0.004 : 0.02;
  for (int i = 0; i <= 8 * 7200; ++i) {
    const int line = std::min(i / 7200, 7);
    const double along = (i - line * 7200) * step - 0.9;
    stroke.time.push_back(i * 1e-3);
    stroke.position.emplace_back(line % 2 == 0 ? along : -along, line * 0.04, z);
    if (tool == Tool::lifted) stroke.contact.push_back(pen_up);
  }
  for (auto _ : state) {
    Simulation simulation(scene, HeightField(scene.bed.rows, scene.bed.cols, scene.bed.cell_size()), stroke);
    TickClock clock;
    const RunResult result = simulation.run({&clock});
    if ((result.contact_ticks > 0) != (tool == Tool::in_sand))
      state.SkipWithError("contact is not as it should be");
    state.SetIterationTime(clock.seconds_per_tick());
  }
}

Scene with_device(DeviceModel model) {
  Scene scene;
  scene.device.model = model;
  return scene;
}
#define SIMULATION_TICK(device, tool)                                                               \
  BENCHMARK_CAPTURE(simulation_tick, device##_##tool, with_device(DeviceModel::device), Tool::tool) \
      ->Name("simulation_tick/" #device "/" #tool)                                                  \
      ->UseManualTime()                                                                             \
      ->Iterations(5)
SIMULATION_TICK(kinematic, in_sand);
SIMULATION_TICK(kinematic, above);
SIMULATION_TICK(kinematic, lifted);
SIMULATION_TICK(dynamic, in_sand);
SIMULATION_TICK(dynamic, lifted);

/// The same tick under another law of the force, with the sphere of the accurate preset.
Scene with_law(ForceLaw law) {
  Scene scene;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.relaxation.way = 0.0;
  scene.force.law = law;
  return scene;
}
#define FORCE_TICK(law)                                                                 \
  BENCHMARK_CAPTURE(simulation_tick, law_##law, with_law(ForceLaw::law), Tool::in_sand) \
      ->Name("simulation_tick/law/" #law)                                               \
      ->UseManualTime()                                                                 \
      ->Iterations(5)
FORCE_TICK(paper);
FORCE_TICK(rft);
FORCE_TICK(archimedes);

}  // namespace
}  // namespace sandstroke
