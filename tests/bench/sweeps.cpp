// A sweep against the same simulations run back to back in one process, without files and measures.
#include "bench/end_to_end.h"
#include "core/output_file.h"
#include "core/stopwatch.h"
#include "core/temporary_folder.h"
#include "sim/simulation.h"
#include "sweep/run_sweep.h"

namespace sandstroke {
namespace {

double back_to_back(const SweepPlan& plan) {
  SweepInputs inputs(plan.scene_folder());
  const Stopwatch watch;
  for (std::size_t point = 0; point < plan.design.points(); ++point) {
    const Scene scene = plan.scene_of(point);
    Simulation simulation(scene, *inputs.bed(scene), inputs.stroke(scene)->stroke);
    simulation.run();
  }
  return watch.seconds();
}

double swept(const SweepPlan& plan, int jobs) {
  const TemporaryFolder folder;
  const Stopwatch watch;
  Sweep sweep(plan);
  SweepOptions options;
  options.jobs = jobs;
  sweep.run(SweepFolder::make(folder.path(), sweep.manifest()), options);
  return watch.seconds();
}

}  // namespace

nlohmann::json measure_sweeps(const BenchOptions& options) {
  const TemporaryFolder folder;
  write_text_file(
      folder / "plan.toml",
      std::string("[sweep]\nscene = \"") + SANDSTROKE_SOURCE +
          "/strokes/wscg/scene.toml\"\n[axes]\nrelaxation.talus_angle = { from = 20, to = 42.5, count = " +
          (options.quick ? "2" : "20") + " }\n");
  const SweepPlan plan = load_plan(folder / "plan.toml");
  std::vector<double> alone, one_job, overhead, speed_up;
  for (int repeat = 0; repeat < (options.quick ? 1 : 5); ++repeat) {  // in turn
    alone.push_back(back_to_back(plan));
    one_job.push_back(swept(plan, 1));
    overhead.push_back(one_job.back() / alone.back());
    speed_up.push_back(one_job.back() / swept(plan, 2));
  }
  return {{"simulations", plan.design.points()},
          {"back_to_back_seconds", spread(alone)},
          {"one_job_seconds", spread(one_job)},
          {"one_job_over_back_to_back", spread(overhead)},
          {"two_jobs_speed_up", spread(speed_up)}};
}

}  // namespace sandstroke
