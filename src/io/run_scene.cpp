#include "io/run_scene.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <optional>

#include "core/hash.h"
#include "core/output_file.h"
#include "core/progress.h"
#include "io/run_writer.h"
#include "io/stroke_file.h"
#include "io/surface_file.h"

namespace sandstroke {
namespace {

/// A run writer that also draws the progress bar.
class WriterWithProgress : public RunWriter {
 public:
  WriterWithProgress(const std::filesystem::path& path, const Simulation& simulation,
                     const std::string& stroke_hash, bool progress)
      : RunWriter(path, simulation, stroke_hash) {
    if (progress) bar_.emplace("run");
  }
  void on_progress(double fraction) override {
    fraction_ = fraction;
    if (bar_) bar_->update(fraction);
  }
  void on_pass(std::int64_t passes) override {
    const bool after_the_stroke = fraction_ == 0.0 || fraction_ == 1.0;
    if (bar_ && after_the_stroke) bar_->count(passes, "passes towards rest");
  }
  void clear_bar() { bar_.reset(); }

 private:
  std::optional<Progress> bar_;
  double fraction_ = 0.0;  // of the stroke
};

}  // namespace

RunResult run_scene(const Scene& scene, const std::filesystem::path& output, const RunOptions& options) {
  const int cores = tbb::info::default_concurrency();
  const int threads = options.threads > 0 ? std::min(options.threads, cores) : cores;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));

  std::optional<Stroke> stroke;
  std::string stroke_hash;
  if (scene.stroke) {
    const std::filesystem::path path = options.scene_folder / scene.stroke->file;
    stroke = place_stroke(load_stroke(path, scene.force), scene.stroke->placement, path.string());
    stroke_hash = content_hash(read_text_file(path));
  }
  Simulation simulation(scene, load_surface(scene.bed, options.scene_folder), std::move(stroke));
  WriterWithProgress writer(output, simulation, stroke_hash, options.progress);
  RunResult result = simulation.run(writer);
  result.threads = threads;
  writer.clear_bar();
  writer.finish(result, simulation.bed());
  return result;
}

}  // namespace sandstroke
