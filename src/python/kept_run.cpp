#include "python/kept_run.h"

#include <pybind11/pybind11.h>

#include "compare/trace_difference.h"
#include "core/error.h"
#include "io/map_on_bed.h"
#include "io/run_file.h"
#include "python/errors.h"
#include "python/interpreter_lock.h"
#include "run/run_summary.h"
#include "run/run_warnings.h"
#include "sand/ground.h"

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

HeightGrid floor_grid(const Ground& ground) {
  const HeightGrid floor = ground.floor.grid();
  return floor.isFinite().select(floor, std::numeric_limits<double>::quiet_NaN());
}

namespace {

/// The part of a run's summary that its file tells, by the names of `run --json`.
nlohmann::ordered_json summary_of_file(const RunFile& file, const KeptRun& run) {
  nlohmann::ordered_json summary = {{"output", run.path}, {"preset", preset_name(run.scene.scene.preset)}};
  double moved = 0.0;
  if (file.has_trace()) {
    std::int64_t contact = 0, saturated = 0;
    double displaced = 0.0;
    for (const TickRecord& tick : run.trace) {
      contact += tick.contact;
      saturated += tick.saturated;
      displaced += tick.displaced_volume;
    }
    const auto [force, depth] = trace_peaks(run.trace);
    summary.update({{"contact_ticks", contact},
                    {"saturated_ticks", saturated},
                    {"displaced_volume", displaced},
                    {"max_force", force},
                    {"max_depth", depth}});
    moved = displaced;
  }
  std::int64_t passes = 0;
  for (const RelaxationRecord& relaxation : run.relaxations) {
    passes += relaxation.outcome.passes;
    moved += relaxation.outcome.moved_volume;
  }
  const double area = run.bed.cell_size() * run.bed.cell_size();
  summary["passes"] = passes;
  if (!run.relaxations.empty()) summary["residual"] = run.relaxations.back().outcome.residual;
  if (file.has_trace() || !run.scene.scene.stroke) summary["moved_volume"] = moved;
  summary["volume_initial"] = area * run.initial.sum();
  summary["volume_final"] = area * run.final.sum();
  if (const std::vector<SourceLedger> sources = file.sources(); !sources.empty())
    summary["sources"] = sources_json(sources);
  if (const std::optional<LoadLedger> load = file.load()) summary["load"] = load_json(*load);
  if (const std::optional<ErrorEstimate> error = file.error_estimate())
    summary["error_estimate"] = error_json(*error);
  return summary;
}

}  // namespace

HeightField surface_of(const Scene& scene, HeightGrid heights) {
  if (heights.rows() != scene.bed.rows || heights.cols() != scene.bed.cols)
    throw_input_error("surface: has {} rows and {} columns, and the scene's bed {} and {} (bed.cells)",
                      heights.rows(), heights.cols(), scene.bed.rows, scene.bed.cols);
  check_no_gaps(heights, scene.bed, "surface", "fill them with a height: numpy.ma.filled(surface, 0.0)");
  check_heights(heights.minCoeff(), heights.maxCoeff(), scene.bed, "surface");
  return HeightField(heights, scene.bed.cell_size(), scene.bed.shape);
}

std::shared_ptr<KeptRun> kept_run(const SceneHere& scene, std::optional<Stroke> stroke,
                                  std::optional<HeightField> surface, const std::filesystem::path& output,
                                  int threads) {
  if (threads < 0) throw_input_error("threads: {} is below 0; 0 is all cores", threads);
  auto run = std::make_shared<KeptRun>();
  run->scene = scene;
  run->path = output.string();
  Keeper keeper(*run);
  RunOptions options;
  options.scene_folder = scene.folder;
  options.threads = threads;
  options.stroke = std::move(stroke);
  options.surface = std::move(surface);
  options.onlooker = [&](const Simulation& simulation) -> SimulationObserver& {
    run->scene.scene = {simulation.scene(), scene.scene.view};
    run->bed = simulation.bed();
    run->initial = simulation.bed().grid();
    if (has_floor(simulation.bed())) run->floor = floor_grid(*simulation.bed().ground());
    run->content = simulation.trace_content();
    return keeper;
  };
  options.at_end = [&](const Simulation& simulation, const RunResult&) {
    run->final = simulation.bed().grid();
  };
  Warnings warnings;
  {
    const WithoutLock let_go;
    RunResult result = run_scene(scene.scene, output, options);
    for (const Warning& warning : warnings_of_run(result, run->scene.scene)) {
      warn(warning);
      result.warnings.push_back(warning);
    }
    run->summary = run_summary(result, run->scene.scene, run->path);
  }
  warnings.give();
  return run;
}

std::shared_ptr<KeptRun> read_run(const std::filesystem::path& path) {
  const WithoutLock let_go;
  const RunFile file(path);
  auto run = std::make_shared<KeptRun>();
  run->scene = {file.scene(), path.parent_path()};
  run->path = path.string();
  run->bed = BedGeometry(file.rows(), file.cols(), file.cell_size());
  run->initial = file.initial();
  run->final = file.final();
  if (const std::shared_ptr<const Ground> ground = file.ground()) run->floor = floor_grid(*ground);
  if (file.has_trace()) {
    run->content = file.trace_content();
    run->trace = file.trace();
  }
  run->relaxations = file.relaxations();
  run->frame_times = file.frame_times();
  RunFrames frames(file);
  for (std::size_t k = 0; k < run->frame_times.size(); ++k)
    append(run->frames, frames.surface(static_cast<int>(k)).grid());
  run->summary = summary_of_file(file, *run);
  return run;
}

}  // namespace sandstroke
