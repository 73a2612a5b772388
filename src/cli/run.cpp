#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/run_film.h"
#include "cli/run_picture.h"
#include "cli/run_view.h"
#include "cli/standard_output.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/interrupt.h"
#include "core/output_file.h"
#include "core/stopwatch.h"
#include "io/film_file.h"
#include "io/input_kind.h"
#include "io/png_file.h"
#include "io/run_file.h"
#include "io/run_state.h"
#include "io/scene_toml.h"
#include "io/xdmf.h"
#include "measure/force_agreement.h"
#include "measure/furrow.h"
#include "measure/stroke_depth.h"
#include "run/run_scene.h"
#include "run/run_summary.h"
#include "run/run_warnings.h"
#include "sim/scene_moisture.h"
#include "sim/simulation.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  std::string scene, output, stroke, picture, video;
  std::vector<std::string> overrides;
  double frames = -1.0;
  int threads = 0;
  std::string estimate_error;  // coarser, finer or empty
  bool error_map = false;
  double checkpoint = 0.0;  // s
  bool resume = false;
  bool view = false, no_open = false;
  bool json = false, strict = false;
};

void print_summary(const RunResult& r, const Scene& scene, const std::string& output,
                   double process_seconds) {
  print_row("run", output);
  print_row("model", "preset " + preset_name(scene.preset));
  if (!r.interrupted) print_row("for ParaView", beside(output, ".xdmf").string());
  if (!scene.stroke && r.ticks > 0)
    print_row("time", fmt::format("{:.3f} s, {} ticks", r.simulated_seconds, r.ticks));
  if (scene.stroke && r.ticks > 0) {
    print_row("stroke", fmt::format("{:.3f} s, {} ticks, {} in contact", r.simulated_seconds, r.ticks,
                                    r.contact_ticks));
    print_row("speed",
              fmt::format("{:.1f} times real time; {:.1f} with reading, writing and measuring",
                          r.simulated_seconds / r.wall_seconds, r.simulated_seconds / process_seconds));
    print_row("largest depth", fmt::format("{:.3f} mm", 1e3 * r.max_depth));
    const bool drag = r.furrow && r.furrow->length >= tool_reach(scene.tool);  // a plunge has no furrow
    if (drag && !std::isnan(r.furrow->depth) && !std::isnan(r.furrow->asked_depth))
      print_row("furrow",
                fmt::format("{:.2f} mm deep; the stroke {} {:.2f} mm{} (medians)", 1e3 * r.furrow->depth,
                            r.followed ? "went" : "asked for", 1e3 * r.furrow->asked_depth,
                            r.followed ? " below the starting surface" : ""));
    if (r.followed && r.followed->ticks > 0)
      print_row("on the sand",
                fmt::format("asked {:.2f} mm and {:.3g} N, reached {:.2f} mm and {:.3g} N (means)",
                            1e3 * r.followed->asked_depth, r.followed->asked_force, 1e3 * r.followed->depth,
                            r.followed->force));
    print_row("largest force",
              fmt::format("{:.3f} N{}", r.device.max_force,
                          r.device.saturated_ticks > 0
                              ? fmt::format(", limited in {} ticks", r.device.saturated_ticks)
                              : ""));
    if (r.recorded_force) print_row("recorded force", text_of(*r.recorded_force));
    print_row("energy into sand",
              fmt::format("{:.4g} J{}", r.device.absorbed_energy,
                          returned_energy(r.device)
                              ? fmt::format(", but the sand returned up to {:.3g} J more than it took",
                                            -r.device.least_absorbed_energy)
                              : ""));
    if (r.stroke.gaps > 0) print_row("gaps", played_text(r.stroke));
  }
  for (const SourceLedger& source : r.sources)
    print_row(source.asked > 0.0 ? "sink" : "source", text_of(source));
  if (r.load) print_row("on the tool", text_of(*r.load, scene.strength.density));
  print_row("sand moved",
            fmt::format("{:.6g} m^3; volume drift {:.1e} of it", r.moved_volume, r.volume_drift));
  if (is_moist(scene))
    print_row("moist sand",
              r.relaxation.failed_volume > 0.0
                  ? fmt::format("cuts failed: {:.3g} m^3 came loose", r.relaxation.failed_volume)
                  : "no cut failed");
  const std::string steps =
      r.relaxation.super_steps > 0 ? fmt::format(" in {} super steps", r.relaxation.super_steps) : "";
  print_row("relaxation",
            fmt::format("{} passes{}, residual {:.2e}, {}", r.relaxation.passes, steps, r.relaxation.residual,
                        r.relaxation.converged ? "at rest" : "NOT AT REST"));
  if (!r.error) return;
  print_row("error of heights",
            fmt::format("+-{:.3g} mm rms, {:.3g} mm at most; {:.2g} % of the changed sand lies elsewhere",
                        1e3 * r.error->height_rms, 1e3 * r.error->height_max, 100.0 * r.error->height_share));
  if (r.ticks > 0)
    print_row("error of force",
              fmt::format("+-{:.3g} N rms, {:.3g} N at most", r.error->force_rms, r.error->force_max));
}

/// Checks that the default output does not replace a finished run of another scene.
void check_default_output(const fs::path& output, const fs::path& scene_path, const SceneFile& scene) {
  if (kind_of(output) != InputKind::run) return;
  const RunFile run(output);
  if (run.scene_text() == scene_text(scene)) return;
  for (const auto& [name, value] : run.provenance())
    if (name == "scene_file" && value != scene_file_entry(scene_path, output))
      throw_input_error(
          "{}: holds the run of another scene ({}); choose another file with -o, or name this one with -o to "
          "replace it",
          output.string(), value);
}

/// Checks every file that the run is to write, before any work. scene_path, output: as run() reads them.
void check_outputs(const RunArguments& arguments, const SceneFile& scene, const fs::path& scene_path,
                   const std::string& output) {
  std::vector<fs::path> files = input_files(scene, folder_of(scene_path));
  files.push_back(scene_path);
  const auto check = [&files](const fs::path& written, const OutputKind& kind) {
    check_output(written, files, kind);
    files.push_back(written);
  };
  check(output, output_kind(InputKind::run));
  check(beside(output, ".xdmf"), xdmf_output);
  if (arguments.output.empty()) check_default_output(output, scene_path, scene);
  if (!arguments.picture.empty()) {
    check_picture_name(arguments.picture);
    check(arguments.picture, picture_output);
  }
  if (!arguments.picture.empty() || !arguments.video.empty()) check_drawable(scene.bed.rows, scene.bed.cols);
  if (arguments.video.empty()) return;
  check_film_name(arguments.video);
  check(arguments.video, film_output);
  if (scene.output.frames == 0.0)
    throw_input_error("--video needs frames, and this run keeps none; add --frames 10");
  if (scene.only_relaxes())
    throw_input_error(
        "--video needs frames, and this scene has none: it has no stroke and no source, so no time passes");
  check_film_program(arguments.video);
}

RunOptions options_of(const RunArguments& arguments) {
  RunOptions options;
  options.scene_folder = folder_of(arguments.scene);
  options.scene_file = arguments.scene;
  options.threads = arguments.threads;
  options.progress = true;
  options.checkpoint = arguments.checkpoint;
  options.resume = arguments.resume;
  options.error_map = arguments.error_map;
  if (!arguments.estimate_error.empty())
    options.second = arguments.estimate_error == second_solution_names.back() ? SecondSolution::finer
                                                                              : SecondSolution::coarser;
  return options;
}

/// Draws the picture and the film that were asked for. Returns the film's exit code.
int draw(const RunArguments& arguments, const SceneFile& scene, const std::string& output) {
  if (!arguments.picture.empty()) {
    write_png(arguments.picture, run_picture(RunFile(output), scene.view));
    if (!arguments.json) print_row("picture", arguments.picture);
  }
  if (arguments.video.empty()) return 0;
  const int exit_code = draw_film(RunFile(output), {scene.view}, std::nullopt, arguments.video);
  if (exit_code == 0 && !arguments.json) print_row("film", arguments.video);
  return exit_code;
}

/// "not-at-rest ([relaxation]), ...", each word once.
std::string doubts_text(const std::vector<Warning>& warnings) {
  std::vector<std::string> words;
  for (const Warning& warning : warnings) {
    const std::string word = fmt::format("{} ([{}])", warning.kind().word, warning.kind().section);
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

int run(const RunArguments& arguments) {
  const fs::path scene_path = arguments.scene;
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.stroke.empty()) overrides.push_back(stroke_override(arguments.stroke));
  if (arguments.frames >= 0.0) overrides.push_back(fmt::format("output.frames={}", arguments.frames));
  const SceneFile scene = load_scene(scene_path, overrides);
  const std::string output = arguments.output.empty() ? scene_path.stem().string() + ".h5" : arguments.output;

  check_outputs(arguments, scene, scene_path, output);

  catch_interrupts();
  RunOptions options = options_of(arguments);
  std::unique_ptr<RunView> view;
  if (arguments.view)
    options.onlooker = [&](Simulation& simulation) -> SimulationObserver& {
      view = open_run_view(simulation, fs::path(output).filename().string(), !arguments.no_open);
      return *view;
    };
  RunResult result = run_scene(scene, output, options);
  if (result.already_complete) {
    if (arguments.json)
      print_json(nlohmann::ordered_json{{"output", output}, {"already_complete", true}});
    else
      print_row("run", output + " is complete already");
    return draw(arguments, scene, output);
  }
  std::vector<Warning> found;
  if (!result.interrupted) found = warnings_of_run(result, scene);
  result.warnings.insert(result.warnings.end(), found.begin(), found.end());
  if (view) view->end(result.interrupted ? "the run was interrupted" : "the run is complete");

  const std::string written = result.interrupted ? part_path(output).string() : output;
  const double process_seconds = process_watch.seconds();
  if (arguments.json) {
    nlohmann::ordered_json summary = run_summary(result, scene, written);
    summary["process_seconds"] = process_seconds;
    summary["process_real_time_factor"] = result.simulated_seconds / process_seconds;
    print_json(summary);
  } else {
    print_summary(result, scene, written, process_seconds);
  }
  if (result.interrupted) return 128 + interrupted();
  if (const int exit_code = draw(arguments, scene, output); exit_code != 0) return exit_code;
  for (const Warning& warning : found) warn(warning);
  if (view && view->lag())
    spdlog::warn(
        "the run was up to {:.2f} s behind real time. The result is the same; fewer bed.cells are faster",
        *view->lag());
  if (arguments.strict && !result.warnings.empty()) {
    spdlog::error("--strict: the result is doubtful: {}; sandstroke help warnings explains the words",
                  doubts_text(result.warnings));
    return static_cast<int>(ErrorKind::unstable);
  }
  if (!result.relaxation.converged || result.device.swings_from) return static_cast<int>(ErrorKind::unstable);
  if (options.second && !result.error)  // the run is complete, but the estimate failed
    return interrupted() ? 128 + interrupted() : static_cast<int>(ErrorKind::unstable);
  return 0;
}

}  // namespace

void add_run_command(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("run", "Simulate a scene: play its stroke, then let the sand come to rest");
  auto arguments = std::make_shared<RunArguments>();
  command->add_option("SCENE", arguments->scene, "Scene file (TOML)")->type_name("FILE.toml")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Run file to write (HDF5). Default: the name of SCENE with .h5, in this folder. The "
                   "default never replaces a run of another scene")
      ->type_name("FILE.h5");
  command
      ->add_option(
          "--stroke", arguments->stroke,
          "Play this stroke instead of the scene's: a script (.toml), a recording (.h5), or any file that "
          "'stroke convert' reads (- is standard input)")
      ->type_name(stroke_file_type);
  add_set_option(*command, arguments->overrides);
  command->add_option("--frames", arguments->frames, "Surfaces to keep per second of stroke [Hz]")
      ->check(not_negative_number());
  command
      ->add_option("--png", arguments->picture, "Picture (PNG) of the final surface, in the scene's [view]")
      ->type_name("FILE.png");
  command
      ->add_option(
          "--video", arguments->video,
          fmt::format("Film of the surfaces that --frames keeps ({}), in the scene's [view]. Needs the "
                      "program ffmpeg",
                      fmt::join(film_endings(), ", ")))
      ->type_name(fmt::format("FILE{}", fmt::join(film_endings(), "|")));
  command
      ->add_option("--threads", arguments->threads,
                   "Number of threads. Default: 0, all cores. The result does not depend on it")
      ->check(CLI::Range(0, 1024));
  command
      ->add_option("--checkpoint", arguments->checkpoint,
                   "Keep the run's state in FILE.h5.state each time so many seconds have passed, between two "
                   "ticks. With it --resume goes on after Ctrl-C, a time limit or a crash")
      ->type_name("SECONDS")
      ->check(positive_number());
  CLI::Option* resume = command->add_flag(
      "--resume", arguments->resume,
      "Go on from the state that --checkpoint kept; the result has the same bits. Without a "
      "state it begins at the start, so one command line does for a job and its requeue");
  CLI::Option* estimate =
      command
          ->add_flag(
              "--estimate-error{finer}", arguments->estimate_error,
              "Estimate the error of heights and forces by a second run with steps half as large. It "
              "takes 10 to 20 times as long. --estimate-error=coarser makes the steps twice as large "
              "instead. It takes a tenth of the run, but misses errors of a tool that few cells resolve")
          ->check(CLI::IsMember(second_solution_names));
  command->add_flag("--error-map", arguments->error_map, "Keep the estimated error of each cell's height too")
      ->needs(estimate);
  auto* shown = command->add_flag(
      "--view", arguments->view,
      "Wait until a page is open in a browser, then play the stroke in real time and show the sand live in "
      "it. Prints the address, and opens it on a desktop. The result is the same");
  shown->excludes(resume);
  command->add_flag("--no-open", arguments->no_open, "Print the address of --view, but do not open it")
      ->needs(shown);
  command->add_flag(
      "--strict", arguments->strict,
      "Exit with code 3 if there is any warning of the run. Its word (\"code\" in --json) and the "
      "section of the scene that it concerns are printed. All words: sandstroke help warnings");
  command->add_flag("--json", arguments->json, "Print the summary as one JSON object");
  command->footer(
      "Examples\n"
      "  sandstroke run strokes/wscg/scene.toml -o wscg.h5 --png wscg.png\n"
      "  a tracing of your own, in any plane, 4 mm deep, in the middle of the bed:\n"
      "    sandstroke run scene.toml --stroke tracing.csv --png tracing.png --set stroke.plane=fit \\\n"
      "        --set stroke.depth=0.004 --set stroke.place=centre --set stroke.fit=0.8\n"
      "  a long run in a Slurm job, which goes on where it was stopped when the job is requeued:\n"
      "    sandstroke run scene.toml -o long.h5 --checkpoint 60 --resume\n"
      "All scene keys with units and defaults:  sandstroke help scene");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace sandstroke
