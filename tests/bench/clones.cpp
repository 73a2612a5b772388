// Copies of a simulation, and kept states: what they cost, and what it costs to go on with one.
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "bench/end_to_end.h"
#include "core/stopwatch.h"
#include "sim/stepped_simulation.h"

namespace sandstroke {
namespace {

double heap_bytes() {
  const auto heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

Scene scene_of(int cells, ModelPreset preset) {
  Scene scene;
  scene.preset = preset;
  apply_model_preset(scene);
  scene.bed.cols = scene.bed.rows = cells;
  scene.bed.width = scene.bed.depth = 0.001 * cells;
  scene.stroke.emplace();
  return scene;
}

/// Waves below the talus slope. All tiles are allocated, as of a surface from a file.
HeightField waves_at_rest(const Scene& scene) {
  HeightGrid heights(scene.bed.rows, scene.bed.cols);
  for (int row = 0; row < heights.rows(); ++row)
    for (int col = 0; col < heights.cols(); ++col)
      heights(row, col) = 0.01 * std::sin(0.03 * row) * std::sin(0.02 * col);
  return HeightField(heights, scene.bed.cell_size());
}

void drag(SteppedSimulation& simulation, int from, int to) {
  for (int k = from; k < to; ++k)
    simulation.tick(Hand{.position = {-0.2 + 1e-4 * k, 0.02 * std::sin(2e-3 * k), -0.004}, .down = true});
}

/// Time and memory of a copy of a simulation that has dragged, and of copies that each go 10 ticks.
nlohmann::json cost(int cells, int copies) {
  const Scene scene = scene_of(cells, ModelPreset::accurate);
  SteppedSimulation simulation(scene, waves_at_rest(scene));
  drag(simulation, 0, 500);
  simulation.lift();
  simulation.relax();
  std::vector<double> microseconds;
  std::vector<std::unique_ptr<SteppedSimulation>> all;
  const double before = heap_bytes();
  for (int i = 0; i < copies; ++i) {
    const Stopwatch watch;
    all.push_back(std::make_unique<SteppedSimulation>(simulation));
    microseconds.push_back(1e6 * watch.seconds());
  }
  const double copied = heap_bytes();
  for (const auto& one : all) drag(*one, 500, 510);
  const double stepped = heap_bytes();
  std::vector<double> state_seconds;
  std::size_t state_bytes = 0;
  for (int i = 0; i < 5; ++i) {
    const Stopwatch watch;
    state_bytes = simulation.state().size();
    state_seconds.push_back(watch.seconds());
  }
  return {{"cells", cells},
          {"copies", copies},
          {"bed_bytes", simulation.bed().bytes()},
          {"microseconds", spread(microseconds)},
          {"bytes", (copied - before) / copies},
          {"bytes_after_10_ticks", (stepped - before) / copies},
          {"state_bytes", state_bytes},
          {"state_seconds", median(state_seconds)}};
}

/// The processor time of a stretch of ticks in a copy, whose original lives, over that of one that was never
/// copied; measured in turn.
nlohmann::json stepping(ModelPreset preset, int cells, int ticks, int repeats) {
  const Scene scene = scene_of(cells, preset);
  std::vector<double> alone, copied;
  for (int i = 0; i < repeats; ++i)
    for (const bool copy : {i % 2 == 0, i % 2 != 0}) {
      SteppedSimulation simulation(scene, waves_at_rest(scene));
      drag(simulation, 0, 200);
      std::unique_ptr<SteppedSimulation> other;
      if (copy) other = std::make_unique<SteppedSimulation>(simulation);
      const double begin = processor_seconds();
      drag(copy ? *other : simulation, 200, 200 + ticks);
      (copy ? copied : alone).push_back(processor_seconds() - begin);
    }
  return {{"preset", preset == ModelPreset::paper ? "paper" : "accurate"},
          {"ticks", ticks},
          {"alone_seconds", spread(alone)},
          {"copy_seconds", spread(copied)},
          {"copy_over_alone", median(copied) / median(alone)}};
}

}  // namespace

nlohmann::json measure_clones(const BenchOptions& options) {
  const bool quick = options.quick;
  nlohmann::json costs = nlohmann::json::array(), steps = nlohmann::json::array();
  for (const int cells : quick ? std::vector{500} : std::vector{500, 2000, 4000})
    costs.push_back(cost(cells, quick ? 20 : 200));
  if (!quick) costs.push_back(cost(500, 10000));
  for (const ModelPreset preset : {ModelPreset::paper, ModelPreset::accurate})
    steps.push_back(stepping(preset, 500, quick ? 200 : 3000, quick ? 3 : 15));
  return {{"costs", costs}, {"steps", steps}};
}

}  // namespace sandstroke
