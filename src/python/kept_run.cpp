#include "python/kept_run.h"

#include <pybind11/pybind11.h>

#include "io/run_file.h"
#include "python/errors.h"
#include "run/run_summary.h"

namespace sandstroke {
namespace {

namespace py = pybind11;

void append(std::vector<double>& heights, const HeightGrid& grid) {
  heights.insert(heights.end(), grid.data(), grid.data() + grid.size());
}

class Keeper : public SimulationObserver {
 public:
  explicit Keeper(KeptRun& run) : run_(run) {}
  void on_tick(const TickRecord& tick) override {
    if (run_.scene.scene.output.trace) run_.trace.push_back(tick);
    signals_.look();
  }
  void on_relaxation(const RelaxationRecord& relaxation) override { run_.relaxations.push_back(relaxation); }
  void on_frame(double time, const HeightField& surface) override {
    run_.frame_times.push_back(time);
    append(run_.frames, surface.grid());
  }
  void on_pass(std::int64_t, const BedNow&) override { signals_.look(); }

 private:
  KeptRun& run_;
  SignalWatch signals_;
};

}  // namespace

std::shared_ptr<KeptRun> kept_run(const SceneHere& scene, std::optional<Stroke> stroke,
                                  const std::filesystem::path& output, int threads) {
  auto run = std::make_shared<KeptRun>();
  run->scene = scene;
  run->path = output.string();
  Keeper keeper(*run);
  RunOptions options;
  options.scene_folder = scene.folder;
  options.threads = threads;
  options.stroke = std::move(stroke);
  options.onlooker = [&](const Simulation& simulation) -> SimulationObserver& {
    run->scene.scene = simulation.scene();
    run->bed = simulation.bed();
    run->initial = simulation.bed().grid();
    run->content = simulation.trace_content();
    return keeper;
  };
  options.at_end = [&](const Simulation& simulation, const RunResult&) {
    run->final = simulation.bed().grid();
  };
  Warnings warnings;
  {
    const py::gil_scoped_release let_go;
    run->summary = run_summary(run_scene(scene.scene, output, options), run->scene.scene, run->path);
  }
  warnings.give();
  return run;
}

std::shared_ptr<KeptRun> read_run(const std::filesystem::path& path) {
  const py::gil_scoped_release let_go;
  const RunFile file(path);
  auto run = std::make_shared<KeptRun>();
  run->scene = {file.scene(), path.parent_path()};
  run->path = path.string();
  run->bed = BedGeometry(file.rows(), file.cols(), file.cell_size());
  run->initial = file.initial();
  run->final = file.final();
  if (file.has_trace()) {
    run->content = file.trace_content();
    run->trace = file.trace();
  }
  run->frame_times = file.frame_times();
  RunFrames frames(file);
  for (std::size_t k = 0; k < run->frame_times.size(); ++k)
    append(run->frames, frames.surface(static_cast<int>(k)));
  return run;
}

}  // namespace sandstroke
