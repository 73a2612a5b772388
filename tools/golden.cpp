#include <spdlog/fmt/fmt.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "compare/golden_scenes.h"
#include "compare/junit.h"
#include "core/interrupt.h"
#include "core/output_file.h"
#include "io/run_scene.h"
#include "io/scene_toml.h"
#include "print_json.h"
#include "run_picture.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> names;
  GoldenFolders folders;
  fs::path report, junit;
  bool json = false;
};

GoldenRun run_golden_scene(const fs::path& scene_file, const fs::path& run_file) {
  Scene scene = load_scene(scene_file);
  RunOptions options;
  options.scene_folder = scene_file.parent_path();
  options.progress = true;
  GoldenRun run{run_file, {}, run_scene(scene, run_file, options)};
  if (run.result.interrupted) return run;
  scene.view.width = 720;  // small enough to keep
  scene.view.height = 405;
  run.picture = run_picture(RunFile(run_file), scene.view);
  return run;
}

std::string summary(const Comparison& comparison) {
  if (comparison.passed()) return fmt::format("ok      {}\n", comparison.name);
  std::string lines = fmt::format("FAILED  {}\n", comparison.name);
  for (const Check& check : comparison.checks)
    if (!check.passed) lines += fmt::format("        {}: {}\n", check.name, check.sentence);
  return lines;
}

int check(const Options& options) {
  if (!options.junit.empty()) check_output(options.junit, {});
  std::vector<Comparison> comparisons;
  nlohmann::json scenes = nlohmann::json::array();
  bool passed = true;
  for (const std::string& name : golden_names(options.folders, options.names)) {
    comparisons.push_back(
        check_golden(name, options.folders, run_golden_scene, Tolerances{}, options.report));
    if (interrupted()) return 128 + interrupted();
    passed = passed && comparisons.back().passed();
    scenes.push_back(to_json(comparisons.back()));
    if (!options.json) fmt::print("{}", summary(comparisons.back()));
    std::fflush(stdout);
  }
  if (!options.junit.empty()) write_text_file(options.junit, junit_report(comparisons));
  if (options.json) print_json(nlohmann::json{{"passed", passed}, {"scenes", scenes}});
  return passed ? 0 : 1;
}

int update(const Options& options) {
  for (const std::string& name : options.names) {
    if (!update_golden(name, options.folders, run_golden_scene)) return 128 + interrupted();
    fmt::print("updated {}\n", options.folders.entry(name).string());
  }
  return 0;
}

void add_folder_options(CLI::App* command, Options& options) {
  command->add_option("--strokes", options.folders.strokes, "Folder with NAME/scene.toml")
      ->type_name("FOLDER")
      ->capture_default_str();
  command->add_option("--golden", options.folders.golden, "Folder with what they must give")
      ->type_name("FOLDER")
      ->capture_default_str();
}

}  // namespace

void add_golden_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* golden = app.add_subcommand("golden", "Run scenes and compare them with what they must give");
  golden->require_subcommand(1);
  golden->footer("Example:  sandstroke golden check --report differences --junit golden.xml");

  CLI::App* check_command =
      golden->add_subcommand("check", "Run all scenes, or those named; exit code 1 if one differs");
  check_command->add_option("NAME", options->names, "Scenes (default: all)")->type_name("SCENE");
  add_folder_options(check_command, *options);
  check_command
      ->add_option("--report", options->report,
                   "Folder for a page and pictures of the differences of each scene")
      ->type_name("FOLDER");
  check_command->add_option("--junit", options->junit, "File for the checks as JUnit XML")
      ->type_name("FILE.xml");
  check_command->add_flag("--json", options->json, "Print one JSON object instead of lines");
  check_command->callback([options, &chosen] { chosen = [options] { return check(*options); }; });

  CLI::App* update_command =
      golden->add_subcommand("update", "Make what scenes give now their golden entries");
  update_command->add_option("NAME", options->names, "Scenes")->type_name("SCENE")->required();
  add_folder_options(update_command, *options);
  update_command->callback([options, &chosen] { chosen = [options] { return update(*options); }; });
}

}  // namespace sandstroke
