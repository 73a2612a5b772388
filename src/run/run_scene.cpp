#include "run/run_scene.h"

#include <spdlog/spdlog.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/hash.h"
#include "core/input_file.h"
#include "core/interrupt.h"
#include "core/machine.h"
#include "core/output_file.h"
#include "core/version.h"
#include "core/warning.h"
#include "haptics/stroke_coverage.h"
#include "haptics/stroke_plane.h"
#include "haptics/stroke_quality.h"
#include "haptics/stroke_smoothing.h"
#include "import/sample_files.h"
#include "io/input_kind.h"
#include "io/mesh_file.h"
#include "io/plugin_file.h"
#include "io/run_file.h"
#include "io/run_state.h"
#include "io/run_writer.h"
#include "io/sand_map_file.h"
#include "io/scene_toml.h"
#include "io/source_path.h"
#include "io/stroke_file.h"
#include "io/surface_file.h"
#include "measure/force_agreement.h"
#include "measure/furrow.h"
#include "measure/stroke_depth.h"
#include "run/run_progress.h"
#include "sand/ground.h"
#include "sim/check_sources.h"
#include "sim/device_force.h"
#include "sim/scene_moisture.h"
#include "sim/tool_fit.h"

namespace sandstroke {
namespace {

/// None if it was interrupted, or if the second solution is unstable; the run itself stays valid.
std::optional<ErrorEstimate> estimated_error(const Scene& scene, const HeightField& start,
                                             const std::optional<Stroke>& stroke, const Solution& run,
                                             const Kept<Eigen::Vector3d>& force, SecondSolution which,
                                             HeightField* map) {
  try {
    const ErrorEstimate error = estimate_error(scene, start, stroke, run, force, which, map);
    if (interrupted()) return std::nullopt;
    if (!error.at_rest)
      warn({WarningCode::error_unreliable,
            "the estimated error is not reliable, because the sand did not come to rest in both solutions; "
            "raise relaxation.max_passes"});
    return error;
  } catch (const Error& failure) {
    if (failure.kind() != ErrorKind::unstable) throw;
    warn({WarningCode::error_unknown,
          fmt::format("the error cannot be estimated, because the {} solution is unstable: {}",
                      which == SecondSolution::finer ? "finer" : "coarser", failure.what())});
    return std::nullopt;
  }
}

/// The stroke as it is played. scripted: no warnings about its samples.
Stroke placed_samples(const Scene& scene, const Stroke& loaded, const std::string& name, bool scripted) {
  Stroke placed = place_on_bed(loaded, scene, name);
  warn_if_any(WarningCode::stroke_gaps, coverage_warning(placed, name));
  if (scene.stroke->placement.plane != StrokePlane::keep) {
    StrokePlacement cut;
    cut.start = scene.stroke->placement.start;
    cut.stop = scene.stroke->placement.stop;
    warn_if_any(WarningCode::stroke_off_plane, off_plane_warning(place_stroke(loaded, cut, name), name));
  }
  const double smooth = scene.stroke->placement.smooth;
  if (smooth > 0.0 && !is_smoothed(loaded, smooth))
    warn({WarningCode::stroke_smooth,
          fmt::format("{}: stroke.smooth = {:.4g} Hz changes nothing, because the stroke's sampling rate is "
                      "less than twice that",
                      name, smooth)});
  if (!scripted)
    for (const std::string& warning : quality_warnings(quality_of(placed)))
      warn({WarningCode::stroke_quality, fmt::format("{}: {}", name, warning)});
  return placed;
}

}  // namespace

Stroke placed_stroke(const Scene& scene, const std::filesystem::path& path, std::string& hash) {
  const std::string name = samples_name(path);
  check_plugin_force(scene, path);
  const Stroke loaded = load_stroke(path, scene.force, scene.stroke->table.value_or(TableSettings{}));
  if (!loaded.complete)
    warn({WarningCode::stroke_cut_off,
          fmt::format("{}: was cut off while it was recorded; the run ends where the stroke ends", name)});
  // A recorded stroke's bytes also tell which build wrote them, so its content is hashed instead.
  hash = is_script(path) && !is_pipe(path) ? file_hash(path) : content_hash(loaded);
  return placed_samples(scene, loaded, name, is_script(path));
}

std::string scene_file_entry(const std::filesystem::path& scene_file, const std::filesystem::path& run_file) {
  const std::filesystem::path folder = std::filesystem::absolute(run_file).parent_path();
  std::error_code of_a_pipe;  // as in check_output
  const std::filesystem::path near = std::filesystem::proximate(scene_file, folder, of_a_pipe);
  return (of_a_pipe ? scene_file : near).generic_string();
}

Scene with_files(Scene scene, const std::filesystem::path& folder) {
  scene.bed = with_own_range(scene.bed, folder);  // so that a run file contains it
  scene.tool = with_mesh(scene.tool, folder);
  scene.ground = with_sand_map(with_meshes(scene.ground, folder), scene.bed, folder);
  if (scene.ground.has_mesh()) check_scene(scene, "the scene");
  if (scene.tool.mesh && scene.stroke) check_tool_fits(scene, (folder / scene.tool.file).string());
  scene.plugin_laws = with_plugin(scene.plugin_laws, folder);
  scene.sources = with_paths(scene.sources, folder);
  if (!scene.sources.empty()) check_sources(scene, "the scene");
  return scene;
}

namespace {

/// A stroke on its bed; none where the bed is only relaxed.
struct PlacedStroke {
  std::optional<Stroke> stroke;
  std::string name, hash;
};

PlacedStroke load_placed(const Scene& scene, const RunOptions& options) {
  PlacedStroke placed;
  if (!scene.stroke) return placed;
  if (options.stroke) {
    placed.name = options.stroke->source;
    placed.hash = content_hash(*options.stroke);
    constexpr bool scripted = false;
    placed.stroke = placed_samples(scene, *options.stroke, placed.name, scripted);
  } else {
    const std::filesystem::path file = stroke_path(scene, options.scene_folder);
    placed.name = samples_name(file);
    placed.stroke = placed_stroke(scene, file, placed.hash);
  }
  return placed;
}

/// Whether this run, by the same build and from the same files, is complete in `output`.
bool is_complete(const std::filesystem::path& output, const std::string& scene,
                 const std::string& stroke_hash, const Simulation& simulation, const RunOptions& options) {
  if (std::filesystem::exists(part_path(output)) || kind_of(output) != InputKind::run) return false;
  const RunFile run(output);
  if (!run.complete() || run.scene_text() != scene) return false;
  const std::string map_hash = sand_map_hash(simulation.scene().ground);
  for (const auto& [name, value] : run.provenance())
    if ((name == "commit" && value != commit) || (name == "stroke_hash" && value != stroke_hash) ||
        (name == sand_map_attribute && value != map_hash))
      return false;
  const std::shared_ptr<const TriangleMesh> mesh = run.scene().tool.mesh, ours = simulation.scene().tool.mesh;
  if (static_cast<bool>(mesh) != static_cast<bool>(ours) || (mesh && *mesh != *ours)) return false;
  bool same = has_floor(simulation.bed()) == (run.ground() != nullptr);
  const auto look = [&](int, int, double one, double other) { same = same && one == other; };
  visit_cells_of_both(run.initial_bed(), simulation.bed(), look);
  if (same && run.ground()) visit_cells_of_both(run.ground()->floor, simulation.bed().ground()->floor, look);
  return same && (!options.second || run.error_estimate()) && (!options.error_map || run.error_map());
}

/// Says of a run that keeps no state, before any work, why not. Error: input.
void check_keeps_state(const Scene& scene) {
  if (keeps_state(scene)) return;
  if (!scene.only_relaxes())
    throw_input_error(
        "the state of a plugin's law is not known, so a run with one keeps none; leave --checkpoint and "
        "--resume out");
  spdlog::warn("the scene has no stroke, so the run keeps no state: it only relaxes the sand");
}

}  // namespace

RunResult run_scene(const SceneFile& asked, const std::filesystem::path& output, const RunOptions& options) {
  const WarningList given;
  const Scene scene = with_files(asked, options.scene_folder);
  const int cores = tbb::info::default_concurrency();
  const int threads = options.threads > 0 ? std::min(options.threads, cores) : cores;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));

  const bool keeps = options.checkpoint > 0.0 || options.resume;
  if (keeps) check_keeps_state(scene);
  if (scene.only_relaxes() && scene.output.frames > 0.0)
    spdlog::warn(
        "the scene has no stroke and no source, so the run keeps no frames, as no time passes; take out "
        "output.frames");
  if (!options.resume && !output.empty()) check_no_state(output);
  const auto [stroke, stroke_name, stroke_hash] = load_placed(scene, options);
  if (options.second) second_scene(scene, *options.second);  // if this is refused, then before any work
  HeightField bed =
      options.surface ? on_ground(*options.surface, scene) : load_bed(scene, options.scene_folder);
  std::optional<HeightField> start;
  if (stroke || options.second || keeps) start = bed;
  if (stroke) check_tool_in_stroke(scene, bed, *stroke, stroke_name);
  Simulation simulation(scene, std::move(bed), stroke);
  if (stroke) {
    warn_if_any(WarningCode::stroke_deep, depth_warning(scene, simulation.bed(), *stroke, stroke_name));
    warn_if_any(WarningCode::tool_coarse,
                coarse_tool_warning(scene, deepest_point(scene, simulation.bed(), *stroke).depth));
    warn_if_any(WarningCode::load_leaks, leaking_tool_warning(scene));
  }
  warn_if_any(WarningCode::moisture_coarse, coarse_moisture_warning(scene));
  if (!output.empty() && simulation.seconds() > 0.0)
    check_disk(output, least_bytes(simulation),
               "choose another place, free disk space, or store less: output.trace = false, fewer "
               "output.frames or an earlier stroke.stop");
  const std::string scene_file =
      options.scene_file.empty() ? "" : scene_file_entry(options.scene_file, output);
  std::optional<StateFile> states;
  Checkpoints checkpoints;
  const auto text = [&] { return scene_text({scene, asked.view}); };
  if (options.resume && is_complete(output, text(), stroke_hash, simulation, options)) {
    remove_state(state_path(output));
    RunResult complete;
    complete.already_complete = true;
    return complete;
  }
  if (keeps) {
    states.emplace(
        state_path(output),
        [&, hash = stroke_hash] {
          return RunState{commit, text(), hash, content_hash(*start), options.second.has_value()};
        },
        options.checkpoint);
    check_part_is_free(output);
    checkpoints = states->checkpoints(options.resume ? state_with_part(*states, output, text()) : "");
  }
  std::optional<RunWriter> writer;
  if (!output.empty()) {
    const auto begins = checkpoints.from.empty() ? Hdf5Writer::Begins::anew : Hdf5Writer::Begins::from_part;
    writer.emplace(output, simulation, asked.view, stroke_hash, scene_file, begins);
    if (checkpoints.from.empty()) remove_state(state_path(output));
  }
  TipPathGatherer path(scene);
  std::optional<RunProgress> bar;
  Kept force(force_of);
  Kept both_forces(forces_of);
  Observers observers = {&path};
  if (writer) observers.push_back(&*writer);
  if (options.progress) observers.push_back(&bar.emplace());
  if (simulation.trace_content().recorded_force) observers.push_back(&both_forces);
  if (options.second) observers.push_back(&force);
  if (options.onlooker) observers.push_back(&options.onlooker(simulation));
  RunResult result = simulation.run(observers, checkpoints);
  result.threads = threads;
  result.recorded_force = force_agreement(both_forces.values);
  if (stroke) result.furrow = path.furrow(*start, simulation.bed());
  bar.reset();
  if (options.at_end) options.at_end(simulation, result);
  if (writer) writer->end(result, simulation.bed());
  if (result.interrupted && states && states->exists())
    spdlog::warn("its state is kept: --resume goes on from there");
  if (stroke)
    warn_if_any(WarningCode::force_theory,
                make_device_force(scene)->theory_warning(scene, result.max_contact_speed));
  result.warnings = given.warnings();
  if (result.interrupted) return result;
  if (options.second) {
    if (options.progress) spdlog::info("estimating the error");
    const HeightField& end = simulation.bed();
    std::optional<HeightField> map;
    if (options.error_map) map.emplace(end.rows(), end.cols(), end.cell_size());
    HeightField* const kept = map ? &*map : nullptr;
    result.error = estimated_error(scene, *start, stroke, {end, result}, force, *options.second, kept);
    if (result.error && writer) writer->write_error(*result.error, kept);
    result.warnings = given.warnings();
    if (interrupted() && !result.error && states && states->exists()) {  // the estimate is still to be made
      spdlog::warn("the error is not estimated yet: --resume goes on from the run's last state");
      result.interrupted = true;
      return result;
    }
  }
  if (writer) writer->finish();
  if (!output.empty()) remove_state(state_path(output));
  return result;
}

}  // namespace sandstroke
