#include "sweep/run_sweep.h"

#include <spdlog/spdlog.h>
#include <sys/time.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "core/error.h"
#include "core/file_lock.h"
#include "core/hash.h"
#include "core/input_file.h"
#include "core/interrupt.h"
#include "core/stopwatch.h"
#include "core/temporary_folder.h"
#include "core/version.h"
#include "io/png_file.h"
#include "io/run_file.h"
#include "io/run_state.h"
#include "io/scene_toml.h"
#include "measure/stroke_depth.h"
#include "sim/check_sources.h"
#include "sim/scene_moisture.h"
#include "sim/tool_fit.h"
#include "sweep/point_runner.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_looked_at = 1000;  // for an estimate

std::string view_text(const SceneFile& scene) { return scene_text({{}, scene.view}); }

/// The cells that view `stroke` shows: those where the hand takes the tool below the starting surface.
CellRange stroke_cells(const SceneFile& scene, const HeightField& bed, const SweepStroke* stroke) {
  if (!stroke || scene.view.name != ViewName::stroke) return {};
  std::vector<Eigen::Vector3d> tips;
  for (std::size_t i = 0; i < stroke->stroke.size(); ++i)
    if (stroke->stroke.pen_down(i)) tips.push_back(tip_of(scene.device, stroke->stroke.position[i]));
  return cells_under(tips, tool_reach(scene.tool), bed, bed.highest());
}

/// The state to go on from. Empty: there is none, or not of this simulation, which begins at its start.
std::string state_or_start(StateFile& states) try { return states.kept(); } catch (const Error& other) {
  spdlog::warn("{}", other.what());
  return "";
}

}  // namespace

std::vector<PointGroup> Shard::among(const std::vector<PointGroup>& groups) const {
  std::vector<PointGroup> mine;
  for (auto group = static_cast<std::size_t>(index - 1); group < groups.size();
       group += static_cast<std::size_t>(of))
    mine.push_back(groups[group]);
  return mine;
}

struct Sweep::Work {
  std::vector<PointGroup> groups;  // the groups to run
  std::size_t points = 0;          // the number of points in them
  double checkpoint = 0.0;         // s
  std::function<void(double)> progress;
  std::function<void()> got_on;  // a point was written, or a state was kept

  std::atomic<std::size_t> next = 0;
  std::mutex mutex;  // guards the members below
  std::size_t points_done = 0, simulations = 0;
  VerdictCounts verdicts{};
  std::exception_ptr failure;

  void count(const PointResult& done) {
    const std::scoped_lock lock(mutex);
    verdicts[static_cast<std::size_t>(done.verdict)] += 1;
    points_done += 1;
    got_on();
    progress(static_cast<double>(points_done) / static_cast<double>(points));
  }
};

Sweep::Sweep(SweepPlan plan, LookAt look_at) : plan_(std::move(plan)), inputs_(plan_.scene_folder()) {
  std::set<fs::path> known_files;
  const auto add_file = [&](const fs::path& path) {
    if (!known_files.insert(path).second) return;
    check_readable(path);
    files_.emplace_back(path.string(), file_hash(path));
  };
  if (!plan_.golden.empty()) golden_ = RunFile(plan_.golden).final_bed();
  bool golden_fits = false;
  std::map<std::string, std::size_t> group_of;  // by sand_key
  const std::size_t points = plan_.design.points();
  for (const std::size_t point : spread_indices(points, look_at == LookAt::some ? most_looked_at : points)) {
    if (interrupted()) break;
    ++looked_at_;
    try {
      const SceneFile scene = plan_.scene_of(point);
      if (plan_.keep_picture) check_drawable(scene.bed.rows, scene.bed.cols);
      golden_fits =
          golden_fits || (golden_ && golden_->rows() == scene.bed.rows && golden_->cols() == scene.bed.cols);
      for (const fs::path& file : input_files(scene, plan_.scene_folder())) add_file(file);
      const auto [found, is_new] =
          group_of.try_emplace(sand_key(scene, inputs_.stroke(scene).get()), groups_.size());
      if (is_new) groups_.emplace_back();
      groups_[found->second].push_back(point);
    } catch (const Error& error) {
      if (is_of_the_machine(error)) throw;
      refused_[point] = error.what();
      groups_.push_back({point});
    }
  }
  if (golden_ && !golden_fits && !interrupted())
    throw_input_error(
        "{}: sweep.golden has {} x {} cells (x, y), and no point's bed has as many; name a run of this scene",
        plan_.file.string(), golden_->cols(), golden_->rows());
}

std::size_t Sweep::simulations() {
  return looked_at_ < plan_.design.points() ? estimated_simulations() : groups_.size() - refused_.size();
}

std::size_t Sweep::estimated_simulations() {
  const SweepDesign& design = plan_.design;
  const auto points = static_cast<double>(design.points());
  if (!design.grid)
    return static_cast<std::size_t>(points * static_cast<double>(groups_.size()) /
                                    static_cast<double>(looked_at_));
  // How many kinds of sand the values of an axis make, beside the first and beside the last point.
  double simulations = 1.0;
  for (std::size_t axis = 0; axis < design.axes.size(); ++axis) {
    const std::size_t values = design.axes[axis].values.size();
    const std::vector<std::size_t> tried = spread_indices(values, 100);
    std::size_t most = 1;
    for (const std::size_t base : {std::size_t{0}, design.points() - 1}) {
      std::set<std::string> sands;
      std::vector<std::string> settings = plan_.settings;
      for (const std::string& setting : design.settings(base)) settings.push_back(setting);
      for (const std::size_t value : tried) {
        settings[plan_.settings.size() + axis] =
            design.axes[axis].key + "=" + design.axes[axis].values[value];
        try {
          const SceneFile scene = plan_.scene_with(settings);
          sands.insert(sand_key(scene, inputs_.stroke(scene).get()));
        } catch (const Error& error) {
          if (is_of_the_machine(error)) throw;
        }
      }
      most = std::max(most, sands.size());
    }
    const double share = static_cast<double>(values) / static_cast<double>(tried.size());
    simulations *= most == 1 ? 1.0 : static_cast<double>(most) * share;
  }
  return static_cast<std::size_t>(std::min(simulations, points));
}

SweepManifest Sweep::manifest() const {
  SweepManifest m;
  m.scene = fs::absolute(plan_.scene).lexically_normal().string();
  m.settings = plan_.settings;
  m.design = plan_.design;
  m.metrics = plan_.metrics;
  m.keep_surface = plan_.keep_surface;
  m.keep_picture = plan_.keep_picture;
  if (plan_.second) m.estimate_error = second_solution_names[static_cast<std::size_t>(*plan_.second)];
  m.inputs.emplace_back(m.scene, content_hash(plan_.scene_text));
  for (const auto& [file, hash] : files_) m.inputs.emplace_back(file, hash);
  if (!plan_.golden.empty()) {
    m.golden = fs::absolute(plan_.golden).lexically_normal().string();
    m.inputs.emplace_back(m.golden, file_hash(plan_.golden));
  }
  m.version = version;
  m.commit = commit;
  m.plan = fs::absolute(plan_.file).lexically_normal().string();
  return m;
}

bool Sweep::run_group(const SweepFolder& folder, const std::vector<std::size_t>& points, double checkpoint,
                      ChangePainter& painter, const std::function<void(const PointResult&)>& written,
                      const std::function<void()>& got_on) {
  const std::size_t metrics = folder.metrics().size();
  const auto write = [&](std::size_t point, const PointResult& result, const std::string& scene,
                         const SweepFolder::Surface& surface) {
    {
      const std::scoped_lock lock(inputs_.files());
      folder.write(point, result, scene, surface);
    }
    written(result);
  };
  std::vector<SceneFile> scenes;
  const auto refuse = [&](const std::string& reason) {
    for (std::size_t i = 0; i < points.size(); ++i)
      write(points[i], failed_point(PointVerdict::refused, reason, metrics),
            i < scenes.size() ? scene_text(scenes[i]) : "", {});
    return false;
  };
  if (const auto refused = refused_.find(points.front()); refused != refused_.end())
    return refuse(refused->second);

  for (const std::size_t point : points) scenes.push_back(plan_.scene_of(point));
  const std::shared_ptr<const SweepStroke> stroke = inputs_.stroke(scenes.front());
  std::shared_ptr<const HeightField> bed;
  try {
    for (SceneFile& scene : scenes) {
      scene.tool = inputs_.tool(scene.tool);
      scene.ground = inputs_.ground(scene);
      scene.plugin_laws = inputs_.plugin_laws(scene.plugin_laws);
      scene.sources = inputs_.sources(scene.sources);
      check_sources(scene, plan_.scene.string());
    }
    const Scene& scene = scenes.front();  // tool, bed and stroke are those of all
    if (scene.ground.has_mesh()) check_scene(scene, "the scene");
    bed = inputs_.bed(scene);
    if (scene.tool.mesh && stroke) check_tool_fits(scene, scene.tool.file);
    if (stroke) check_tool_in_stroke(scene, *bed, stroke->stroke, scene.stroke->file);
  } catch (const Error& error) {
    if (is_of_the_machine(error)) throw;
    return refuse(error.what());
  }
  const auto what = [&] {
    std::string text;
    for (const SceneFile& scene : scenes) text += scene_text(scene);
    return RunState{commit, text, stroke ? stroke->hash : "", content_hash(*bed), plan_.second.has_value()};
  };
  const fs::path state_file = folder.state_file(points.front());
  StateFile states(state_file, what, checkpoint);
  Checkpoints checkpoints;
  if (keeps_state(scenes.front())) {
    checkpoints = states.checkpoints(state_or_start(states));
    if (checkpoints.keep)
      checkpoints.keep = [keep = std::move(checkpoints.keep), &states, &got_on](std::string state) {
        keep(std::move(state));
        if (!states.failed()) got_on();
      };
  }
  const std::optional<SharedRunResult> result =
      run_shared({scenes.begin(), scenes.end()}, *bed, stroke ? &stroke->stroke : nullptr, folder.metrics(),
                 golden_ ? &*golden_ : nullptr, plan_.second, checkpoints);
  if (!result) return false;
  if (stroke) {
    const Scene& scene = scenes.front();
    const std::string warning = depth_warning(scene, *bed, stroke->stroke, scene.stroke->file);
    const std::scoped_lock lock(too_deep_mutex_);
    for (const std::size_t point : points)
      if (!warning.empty()) too_deep_[point] = warning;
  }

  std::optional<Image> picture;
  std::string pictured_view;
  SweepFolder::Surface kept{plan_.keep_surface ? &result->surface : nullptr};
  for (std::size_t i = 0; i < points.size() && (i == 0 || !interrupted()); ++i) {
    const bool surface = !failed(result->points[i].verdict);
    if (surface && plan_.keep_picture) {
      if (const std::string view = view_text(scenes[i]); !picture || view != pictured_view) {
        picture = painter.draw(*bed, result->surface, stroke_cells(scenes[i], *bed, stroke.get()),
                               scenes[i].view, slope_of_crumbs(scenes[i]));
        pictured_view = view;
      }
      write_png(folder.picture_file(points[i]), *picture);
    }
    write(points[i], result->points[i], scene_text(scenes[i]), surface ? kept : SweepFolder::Surface{});
    if (surface && plan_.keep_surface && !kept.same_as) kept.same_as = points[i];
  }
  remove_state(state_file);
  return true;
}

void Sweep::work_through(const SweepFolder& folder, Work& work) {
  ChangePainter painter;
  while (!interrupted()) {
    const std::size_t mine = work.next++;
    if (mine >= work.groups.size()) return;
    try {
      const bool simulated = run_group(
          folder, work.groups[mine], work.checkpoint, painter,
          [&](const PointResult& result) { work.count(result); }, work.got_on);
      const std::scoped_lock lock(work.mutex);
      work.simulations += simulated;
    } catch (...) {
      const std::scoped_lock lock(work.mutex);
      work.failure = std::current_exception();
      work.next = work.groups.size();  // no thread begins another
      return;
    }
  }
}

SweepCounters Sweep::run(const SweepFolder& folder, const SweepOptions& options) {
  SweepCounters counters;
  Work work;
  work.progress = options.progress;
  work.checkpoint = options.checkpoint;
  const fs::path lock_path =
      folder.path() / "points" / fmt::format(".shard-{}-of-{}", options.shard.index, options.shard.of);
  work.got_on = [&] { utimes(lock_path.c_str(), nullptr); };  // a Slurm task looks at it (slurm_script.cpp)
  const std::optional<FileLock> lock = FileLock::try_take(lock_path);
  if (!lock)
    throw_io_error(
        "{}: another process runs this part of the sweep; wait for it, or share the work with --shard",
        folder.path().string());
  for (const PointGroup& group : options.shard.among(groups_)) {
    PointGroup missing;
    for (const std::size_t point : group) {
      const std::optional<PointResult> done = folder.read(point);
      counters.points += 1;
      counters.done_before += done.has_value();
      if (done) {
        work.verdicts[static_cast<std::size_t>(done->verdict)] += 1;
        remove_state(folder.state_file(point));  // a kill came before that
      }
      if (!done) missing.push_back(point);
    }
    work.points += missing.size();
    if (!missing.empty()) work.groups.push_back(std::move(missing));
  }

  // On a cluster's node, or beside other shards, a sweep uses no more cores than it was given.
  const int cores = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  const int jobs = std::min(cores, static_cast<int>(std::max<std::size_t>(1, work.groups.size())));
  // Each job has its own thread. The remaining cores help them.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(std::max(1, cores - jobs + 1)));
  {
    std::vector<std::jthread> others;
    for (int job = 1; job < jobs; ++job) others.emplace_back([&] { work_through(folder, work); });
    work_through(folder, work);
  }
  if (work.failure) std::rethrow_exception(work.failure);

  counters.run = work.points_done;
  counters.verdicts = work.verdicts;
  counters.simulations = work.simulations;
  counters.strokes_loaded = inputs_.strokes_loaded();
  counters.beds_loaded = inputs_.beds_loaded();
  counters.interrupted = work.points_done < work.points;
  return counters;
}

Sweep::Estimate Sweep::estimate() {
  const TemporaryFolder temporary;
  const SweepFolder folder = SweepFolder::make(temporary.path(), manifest());
  std::size_t measured = groups_.size() / 2;  // or the next group that can run
  for (std::size_t i = 0; i < groups_.size() && refused_.contains(groups_[measured].front()); ++i)
    measured = (measured + 1) % groups_.size();
  ChangePainter painter;
  const Stopwatch watch;
  // Two points, if they share a simulation: the second keeps no surface of its own. They do not share the
  // second solution of an error estimate, whose time counts for each point.
  const PointGroup& group = groups_[measured];
  const PointGroup run(group.begin(),
                       group.begin() + std::min<std::ptrdiff_t>(plan_.second ? 1 : 2, std::ssize(group)));
  constexpr double no_checkpoint = 0.0;
  run_group(
      folder, run, no_checkpoint, painter, [](const PointResult&) {}, [] {});
  Estimate estimate;
  // Points do not share second solutions.
  estimate.seconds =
      watch.seconds() * static_cast<double>(plan_.second ? plan_.design.points() : simulations());
  const auto bytes_of = [](const fs::path& file) {
    std::error_code none;
    const auto size = fs::file_size(file, none);
    return none ? 0.0 : static_cast<double>(size);
  };
  const auto points = static_cast<double>(plan_.design.points());
  const double alone = static_cast<double>(simulations());
  estimate.bytes = points * bytes_of(folder.picture_file(run.front())) +
                   alone * bytes_of(folder.point_file(run.front())) +
                   (points - alone) * bytes_of(folder.point_file(run.back()));
  return estimate;
}

}  // namespace sandstroke
