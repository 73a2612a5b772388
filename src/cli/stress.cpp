#include "validation/stress/stress.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/plugin_options.h"
#include "cli/standard_output.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/interrupt.h"
#include "core/output_file.h"
#include "core/progress.h"
#include "core/stopwatch.h"
#include "io/scene_toml.h"
#include "io/table.h"
#include "report/page.h"
#include "run/run_scene.h"
#include "validation/stress/scene_loop.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct StressArguments {
  fs::path output = "stress", scene;
  PluginOptions plugin;
  bool quick = false, json = false;
};

/// Counts the verdicts and surprises in each group of cases and in each map.
Table counts(const StressReport& report) {
  constexpr Verdict verdicts[] = {Verdict::stable,  Verdict::limit_cycle,   Verdict::diverged,
                                  Verdict::refused, Verdict::not_converged, Verdict::broken};
  std::vector<std::string> names;
  std::map<Verdict, std::vector<double>> seen;
  std::vector<double> surprises;
  const auto add = [&](const std::string& name, Verdict verdict, bool surprise) {
    const auto row = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (row == names.size()) {
      names.push_back(name);
      for (const Verdict any : verdicts) seen[any].push_back(0.0);
      surprises.push_back(0.0);
    }
    seen[verdict][row] += 1.0;
    surprises[row] += surprise;
  };
  for (const StressCase& one : report.cases) add(one.group, one.verdict, one.surprise());
  for (const StabilityMap& map : report.maps)
    for (std::size_t row = 0; row < map.verdict.size(); ++row)
      for (std::size_t col = 0; col < map.verdict[row].size(); ++col)
        add("map: " + map.title, map.verdict[row][col], map.surprise[row][col]);
  Table table{{{"name", "", "", names}}};
  for (const Verdict verdict : verdicts)
    table.columns.push_back({name_of(verdict), name_of(verdict), "", seen[verdict]});
  table.columns.push_back({"surprises", "surprises", "", surprises});
  return table;
}

/// How far the loops are from their boundaries, a row for each setting.
Table margins(const StressReport& report) {
  std::vector<std::string> loops, settings, units;
  std::vector<double> values, boundaries, factors;
  for (const LoopMargins& loop : report.margins)
    for (const Margin& margin : loop.margins) {
      loops.push_back(loop.name + (loop.stable ? "" : " (UNSTABLE)"));
      settings.push_back(margin.what);
      units.push_back(margin.unit);
      values.push_back(margin.value);
      boundaries.push_back(margin.boundary);
      factors.push_back(margin.factor);
    }
  return {{{"loop", "Margins of", "", loops},
           {"setting", "Setting", "", settings},
           {"value", "Now", "", values},
           {"boundary", "Stable to", "", boundaries},
           {"unit", "", "", units},
           {"factor", "Factor", "", factors}}};
}

void print_summary(const StressReport& report) {
  if (!report.margins.empty()) print_text("{}\n", aligned_text(margins(report), 3));
  print_text("{}", aligned_text(counts(report), 9));
  for (const StressCase& one : report.cases)
    if (one.surprise())
      spdlog::error("surprise: {}, {}: {} where {} was expected ({})", one.group, one.name,
                    name_of(one.verdict), one.expected.empty() ? "nothing" : name_of(one.expected.front()),
                    one.detail);
}

/// Runs a scene. Returns the loop of its stiffest contact; none if it was interrupted.
std::optional<LoopSettings> loop_of_scene(const fs::path& path) {
  const SceneFile scene = load_scene(path);
  RunOptions run;
  run.scene_folder = folder_of(path);
  run.progress = true;
  std::optional<StiffestContact> contact;
  run.onlooker = [&](Simulation& simulation) -> SimulationObserver& {
    return contact.emplace(simulation.scene());
  };
  try {
    run_scene(scene, "", run);
  } catch (const Error& failure) {
    if (failure.kind() != ErrorKind::unstable || !contact) throw;
    spdlog::warn("{}; the margins are those of the contacts until then", failure.what());
  }
  return interrupted() ? std::nullopt : std::optional(contact->loop());
}

/// Whether all went as it should: no case surprised, and the scene's own loop is stable.
bool is_sound(const StressReport& report) {
  return report.surprises() == 0 && std::all_of(report.margins.begin(), report.margins.end(),
                                                [](const LoopMargins& loop) { return loop.stable; });
}

int stress(const StressArguments& arguments) {
  const fs::path page = arguments.output / "stress.html";
  StressOptions options;
  options.quick = arguments.quick;
  options.plugin_laws = arguments.plugin.laws();
  make_folder(arguments.output);
  check_output(page, {}, page_output);
  catch_interrupts();
  const Stopwatch watch;
  std::optional<LoopSettings> own;
  if (!arguments.scene.empty() && !(own = loop_of_scene(arguments.scene))) return 128 + interrupted();
  Progress bar("stress");
  options.progress = [&bar](double fraction) { bar.update(fraction); };
  const StressReport report = own ? stress_scene(*own, options) : stress_all(options);
  if (interrupted()) return 128 + interrupted();

  nlohmann::ordered_json data = as_json(report);
  data["machine"] = describe_machine();
  data["quick"] = arguments.quick;
  data["seconds"] = watch.seconds();
  write_text_file(page, stress_page(data), page_output);
  if (arguments.json) {
    print_json(data);
  } else {
    print_summary(report);
    print_text("\nThe maps: {}\n", page.string());
  }
  return is_sound(report) ? 0 : static_cast<int>(ErrorKind::unstable);
}

}  // namespace

void add_stress_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "stress",
      "Test the numerical stability of the device loop, relaxation and strokes, up to their limits");
  auto arguments = std::make_shared<StressArguments>();
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for the page, stress.html; it is made if it does not exist")
      ->type_name("FOLDER")
      ->capture_default_str();
  CLI::Option* scene =
      command
          ->add_option("--scene", arguments->scene,
                       "Judge only this scene: the margins of its device and sand, and maps about its "
                       "settings")
          ->type_name("SCENE");
  command->add_flag("--quick", arguments->quick,
                    "Take 45 seconds instead of 10 minutes, with coarser maps, fewer and shorter cases");
  arguments->plugin.add_to(*command, "Plugin (.so) whose laws are tested instead of the program's");
  command->get_option("--plugin")->excludes(scene);
  command->add_flag("--json", arguments->json,
                    "Print the page's data as one JSON object instead of the table");
  command->footer(
      "Each case has expected verdicts. A case with another verdict is a surprise. The exit code is then 3,\n"
      "and also if the scene's loop is unstable.\n"
      "Examples:\n"
      "  sandstroke stress --quick -o out/stress\n"
      "  sandstroke stress --scene scene.toml       am I stable, and by how much?");
  command->callback([arguments, &chosen] { chosen = [arguments] { return stress(*arguments); }; });
}

}  // namespace sandstroke
