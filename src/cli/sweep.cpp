#include <spdlog/spdlog.h>

#include <charconv>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/standard_output.h"
#include "cli/sweep_parts.h"
#include "core/counted.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "io/table.h"
#include "sweep/run_sweep.h"
#include "sweep/slurm_jobs.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct SweepArguments {
  fs::path plan, output;
  int jobs = 0;
  std::string shard;
  double checkpoint = SweepOptions{}.checkpoint;  // s
  bool dry_run = false, json = false;
  SlurmArguments slurm;
};

Shard parse_shard(const std::string& text) {
  Shard shard;
  if (text.empty()) return shard;
  const char* end = text.data() + text.size();
  const auto [slash, bad_index] = std::from_chars(text.data(), end, shard.index);
  const bool divided = bad_index == std::errc() && slash != end && *slash == '/';
  const auto [rest, bad_of] = std::from_chars(divided ? slash + 1 : end, end, shard.of);
  if (!divided || bad_of != std::errc() || rest != end || shard.index < 1 || shard.index > shard.of)
    throw_input_error("--shard {} is not a part of a sweep; write I/N with 1 <= I <= N, such as 1/4", text);
  return shard;
}

/// The first points of a sweep and its last one, as a table; dots where points are not shown.
std::string points_text(const SweepDesign& design) {
  constexpr std::size_t most = 6;
  std::vector<std::size_t> shown;
  for (std::size_t point = 0; point < std::min(most - 1, design.points()); ++point) shown.push_back(point);
  if (design.points() >= most) shown.push_back(design.points() - 1);
  Table table{{{"point", "point", "", std::vector<double>(shown.begin(), shown.end())}}};
  for (std::size_t i = 0; i < design.axes.size(); ++i) {
    std::vector<std::string> labels;
    for (const std::size_t point : shown) labels.push_back(design.axes[i].label(design.value_at(point, i)));
    table.columns.push_back({design.axes[i].key, design.axes[i].key, design.axes[i].unit, labels});
  }
  std::string text = aligned_text(table, 9);
  if (design.points() > most) text.insert(text.rfind('\n', text.size() - 2) + 1, "...\n");
  return text;
}

std::string duration(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

void warn_of_depth(const Sweep& sweep) {
  if (sweep.too_deep().empty()) return;
  const auto& [point, sentence] = *sweep.too_deep().begin();
  spdlog::warn("the stroke goes deep in {} points; the first is point {}: {}", sweep.too_deep().size(), point,
               sentence);
}

fs::path output_folder(const SweepArguments& arguments) {
  return arguments.output.empty() ? arguments.plan.stem() : arguments.output;
}

/// What the jobs are asked for, with what their sweeps get from this one.
SlurmArguments slurm_of(const SweepArguments& arguments) {
  SlurmArguments slurm = arguments.slurm;
  if (arguments.checkpoint != SweepOptions{}.checkpoint)
    slurm.options.arguments = fmt::format(" --checkpoint {}", arguments.checkpoint);
  return slurm;
}

int dry_run(Sweep& sweep, const SweepArguments& arguments) {
  if (!arguments.json) spdlog::info("runs one point, to measure it");
  const Sweep::Estimate estimate = sweep.estimate();
  if (interrupted()) return 128 + interrupted();
  const SweepDesign& design = sweep.plan().design;
  warn_of_depth(sweep);
  if (!sweep.refused().empty())
    spdlog::warn(
        "the settings of {} points{} contradict each other; the first is point {}: {}",
        sweep.refused().size(),
        sweep.looked_at() < design.points() ? fmt::format(" of {} looked at", sweep.looked_at()) : "",
        sweep.refused().begin()->first, sweep.refused().begin()->second);
  const std::string script =
      arguments.slurm.submit
          ? job_script(slurm_of(arguments), arguments.plan, output_folder(arguments), sweep.simulations())
          : "";
  if (arguments.json) {
    nlohmann::ordered_json json{{"points", design.points()},
                                {"simulations", sweep.simulations()},
                                {"looked_at", sweep.looked_at()},
                                {"refused", sweep.refused().size()},
                                {"seconds_on_one_core", estimate.seconds},
                                {"bytes", estimate.bytes}};
    if (!script.empty()) json["job_script"] = script;
    print_json(json);
    return 0;
  }
  print_text("{}", points_text(design));
  print_text("\n{} points need {}{} simulations: about {} on one core and {:.3g} MB, measured on one point\n",
             design.points(), sweep.looked_at() < design.points() ? "about " : "", sweep.simulations(),
             duration(estimate.seconds), estimate.bytes * 1e-6);
  if (!script.empty())
    print_text("\n--slurm would submit this job array, and a job that collects:\n\n{}", script);
  return 0;
}

void print_summary(const SweepCounters& counters, const SweepFolder& folder) {
  std::string verdicts;
  for (std::size_t i = 0; i < counters.verdicts.size(); ++i)
    if (counters.verdicts[i] > 0) verdicts += fmt::format(", {} {}", counters.verdicts[i], verdict_names[i]);
  print_row("points", fmt::format("{}: {} run now, {} before{}", counters.points, counters.run,
                                  counters.done_before, verdicts));
  print_row("simulations", fmt::format("{}{}", counters.simulations,
                                       counters.simulations < counters.run
                                           ? "; points that differ only in force constants share a simulation"
                                           : ""));
  print_row("loaded", fmt::format("beds: {}, strokes: {}", counters.beds_loaded, counters.strokes_loaded));
  print_row("folder", folder.path().string());
}

nlohmann::ordered_json as_json(const SweepCounters& c, const SweepFolder& folder) {
  return {{"folder", folder.path().string()},
          {"points", c.points},
          {"run", c.run},
          {"done_before", c.done_before},
          {"failed", c.failed()},
          {"not_at_rest", c.of(PointVerdict::not_at_rest)},
          {"active", c.of(PointVerdict::active)},
          {"simulations", c.simulations},
          {"beds_loaded", c.beds_loaded},
          {"strokes_loaded", c.strokes_loaded},
          {"interrupted", c.interrupted}};
}

int sweep(const SweepArguments& arguments) {
  if (arguments.plan.empty())
    throw_input_error("sweep: name a plan, or use status or collect (sandstroke sweep --help)");
  SweepOptions options;
  options.jobs = arguments.jobs;
  options.shard = parse_shard(arguments.shard);
  options.checkpoint = arguments.checkpoint;
  SweepPlan plan = load_plan(arguments.plan);
  for (const std::string& note : plan.notes) spdlog::info("{}", note);
  catch_interrupts();
  Sweep sweep(std::move(plan), arguments.dry_run ? LookAt::some : LookAt::all);
  if (interrupted()) return 128 + interrupted();
  if (arguments.dry_run) return dry_run(sweep, arguments);

  if (arguments.slurm.submit) check_slurm();
  const SweepFolder folder = SweepFolder::make(output_folder(arguments), sweep.manifest());
  check_collectable(folder);
  if (arguments.slurm.submit)
    return submit_sweep(slurm_of(arguments), arguments.plan, folder, sweep.groups(), arguments.json);
  SweepCounters counters;
  {
    Progress bar("sweep");
    options.progress = [&bar](double fraction) { bar.update(fraction); };
    counters = sweep.run(folder, options);
  }
  if (!arguments.json) print_summary(counters, folder);
  nlohmann::ordered_json json = as_json(counters, folder);
  const bool all = !counters.interrupted && options.shard.of == 1;
  bool lost = false;
  if (all) {
    const CollectReport collected = collect_sweep(folder, arguments.json);
    json["content_hash"] = collected.content_hash;
    lost = collected.missing + collected.unreadable > 0;  // somebody removed or damaged points
  }
  if (arguments.json) print_json(json);
  warn_of_depth(sweep);
  if (counters.interrupted) {
    spdlog::warn("stopped with {} of {} points done; the same command continues",
                 counters.done_before + counters.run, counters.points);
    return 128 + interrupted();
  }
  if (const std::size_t active = counters.of(PointVerdict::active))
    spdlog::warn("{} active: the sand returned energy there, so the loop was not passive",
                 counted(active, "point"));
  const std::size_t restless = counters.of(PointVerdict::not_at_rest);
  if (restless > 0)
    spdlog::warn("{} not at rest; raise relaxation.max_passes or relaxation.tolerance",
                 counted(restless, "point"));
  if (counters.failed() > 0 && !all)  // collecting has reported it
    spdlog::warn("{} without result; see: sandstroke sweep status {}", counted(counters.failed(), "point"),
                 folder.path().string());
  if (lost) return static_cast<int>(ErrorKind::io);
  return counters.failed() + restless > 0 ? static_cast<int>(ErrorKind::unstable) : 0;
}

}  // namespace

void add_sweep_folder_command(CLI::App& sweep, const char* name, const char* help, const char* footer,
                              int (*run)(const SweepFolder& folder, bool json), Command& chosen) {
  struct FolderArguments {
    fs::path folder;
    bool json = false;
  };
  CLI::App* command = sweep.add_subcommand(name, help);
  auto arguments = std::make_shared<FolderArguments>();
  command->add_option("FOLDER", arguments->folder, "Folder of the sweep, as named with -o")
      ->type_name("FOLDER")
      ->option_text("REQUIRED")
      ->required();
  command->add_flag("--json", arguments->json, "Print it as one JSON object");
  command->footer(footer);
  command->callback([arguments, run, &chosen] {
    chosen = [arguments, run] { return run(SweepFolder::open(arguments->folder), arguments->json); };
  });
}

void add_sweep_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("sweep", "Run a scene many times with different settings");
  auto arguments = std::make_shared<SweepArguments>();
  command->add_option("PLAN", arguments->plan, "Plan of the sweep (TOML)")->type_name("FILE.toml");
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for the results. Default: the name of PLAN without .toml, in this folder. A sweep "
                   "that was begun there continues")
      ->type_name("FOLDER");
  CLI::Option* jobs =
      command
          ->add_option("--jobs", arguments->jobs,
                       "Number of cores, one simulation each. 0: all. The results do not depend on it")
          ->check(CLI::Range(0, 1024));
  CLI::Option* shard =
      command->add_option("--shard", arguments->shard, "Run only part I of N, for example 1/4")
          ->type_name("I/N");
  command
      ->add_option(
          "--checkpoint", arguments->checkpoint,
          fmt::format("Keep each simulation's state every so many seconds: the same command goes on from "
                      "it. Default: {:g}. 0: never",
                      arguments->checkpoint))
      ->check(not_negative_number());
  command
      ->add_flag("--dry-run", arguments->dry_run,
                 "Run nothing but one point. Print the number of points, the first ones and the last, and "
                 "the time and memory expected; with --slurm also the job script. Looks at 1000 points at "
                 "most")
      ->excludes(shard);
  command->add_flag("--json", arguments->json, "Print the summary as one JSON object");
  add_slurm_options(*command, arguments->slurm);
  command->get_option("--slurm")->excludes(shard)->excludes(jobs);
  add_sweep_status_command(*command, chosen);
  add_sweep_collect_command(*command, chosen);
  command->footer(
      "A plan (all its keys: sandstroke help plan):\n"
      "  [sweep]\n"
      "  scene = \"scene.toml\"\n"
      "  [axes]\n"
      "  relaxation.talus_angle = { from = 20, to = 45, step = 2.5 }\n"
      "  force.k_s = [500, 1000]\n"
      "Example:  sandstroke sweep plan.toml -o results\n"
      "A point that is not at rest needs more relaxation.max_passes. In an active point the sand returned\n"
      "energy to the device, so the loop was not passive. Unstable and refused points have no result.\n"
      "Exit code 3: points are not at rest or have no result. The same command continues a stopped sweep.");
  command->callback([arguments, command, &chosen] {
    if (command->get_subcommands().empty()) chosen = [arguments] { return sweep(*arguments); };
  });
}

}  // namespace sandstroke
