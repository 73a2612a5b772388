#include <spdlog/fmt/fmt.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/run_picture.h"
#include "cli/standard_output.h"
#include "cli/tolerance_options.h"
#include "compare/golden_scenes.h"
#include "compare/junit.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/output_file.h"
#include "io/scene_toml.h"
#include "pages/compare_page.h"
#include "pages/golden_index.h"
#include "report/page.h"
#include "run/run_scene.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

struct GoldenArguments {
  std::vector<std::string> names;
  GoldenFolders folders;
  GivenTolerances tolerances;
  fs::path report, junit;
  bool all_pages = false, json = false, doubtful = false;
};

GoldenRun run_golden_scene(const fs::path& scene_file, const fs::path& run_file) {
  SceneFile scene = load_scene(scene_file);
  RunOptions arguments;
  arguments.scene_folder = scene_file.parent_path();
  arguments.progress = true;
  GoldenRun run{run_file, {}, run_scene(scene, run_file, arguments)};
  if (run.result.interrupted) return run;
  scene.view.width = 720;  // small enough to keep
  scene.view.height = 405;
  run.picture = run_picture(RunFile(run_file), scene.view);
  return run;
}

std::string summary(const Comparison& comparison) {
  std::string lines = fmt::format("{}  {}\n", comparison.passed() ? "ok    " : "FAILED", comparison.name);
  if (const std::string changed = changed_tolerances(comparison.tolerances); !changed.empty())
    lines += fmt::format("        tolerances: {}\n", changed);
  for (const Check& check : comparison.checks)
    if (!check.passed) lines += fmt::format("        {}: {}\n", check.name, check.sentence);
  return lines;
}

fs::path page_path(const fs::path& report, const std::string& name) { return report / (name + ".html"); }

fs::path index_path(const fs::path& report) { return report / "index.html"; }

/// Keeps what the index shows of a scene, and writes the scene's page where that differs, was asked for, or
/// would be out of date.
ComparisonWatcher page_writer(const GoldenArguments& arguments, GoldenVerdict& verdict) {
  if (arguments.report.empty()) return {};
  return [&](const GoldenEntry& entry, const GoldenRun& run, const Comparison& comparison,
             const Tolerances& tolerances) {
    verdict.picture = run.picture;
    const fs::path page = page_path(arguments.report, entry.name);
    verdict.page = arguments.all_pages || !comparison.passed() || fs::exists(page);
    if (verdict.page)
      write_text_file(page, golden_page(entry, run, comparison, tolerances).html(), page_output);
  };
}

int check(const GoldenArguments& arguments) {
  const std::vector<std::string> names = golden_names(arguments.folders, arguments.names);
  std::vector<fs::path> files;
  if (!arguments.report.empty()) {
    for (const std::string& name : names)
      if (page_path(arguments.report, name) == index_path(arguments.report))
        throw_input_error("a scene is called \"{}\", as the page of all scenes is; rename its folder", name);
    make_folder(arguments.report);  // the JUnit file may lie in it
  }
  if (!arguments.junit.empty()) {
    check_output(arguments.junit, {}, junit_output);
    files.push_back(arguments.junit);
  }
  if (!arguments.report.empty()) {
    check_output(index_path(arguments.report), files, page_output);
    for (const std::string& name : names) check_output(page_path(arguments.report, name), files, page_output);
  }
  catch_interrupts();
  std::vector<Comparison> comparisons;
  std::vector<GoldenVerdict> verdicts;
  nlohmann::json scenes = nlohmann::json::array();
  bool passed = true;
  for (const std::string& name : names) {
    GoldenVerdict& verdict = verdicts.emplace_back();
    comparisons.push_back(check_golden(name, arguments.folders, run_golden_scene, arguments.tolerances,
                                       page_writer(arguments, verdict)));
    verdict.comparison = comparisons.back();
    if (interrupted()) return 128 + interrupted();
    passed = passed && comparisons.back().passed();
    scenes.push_back(to_json(comparisons.back()));
    if (!arguments.json) print_text("{}", summary(comparisons.back()));
    flush_output();
  }
  if (!arguments.junit.empty()) write_text_file(arguments.junit, junit_report(comparisons), junit_output);
  if (!arguments.report.empty())
    write_text_file(index_path(arguments.report), golden_index(verdicts), page_output);
  if (arguments.json)
    print_json(nlohmann::json{{"passed", passed}, {"scenes", scenes}});
  else if (!arguments.report.empty())
    print_text("pages   {}\n", index_path(arguments.report).string());
  return passed ? 0 : 1;
}

int update(const GoldenArguments& arguments) {
  catch_interrupts();
  for (const std::string& name : arguments.names) {
    if (!update_golden(name, arguments.folders, run_golden_scene, arguments.doubtful))
      return 128 + interrupted();
    print_text("updated {}\n", arguments.folders.entry(name).folder.string());
  }
  return 0;
}

void add_folder_options(CLI::App* command, GoldenArguments& arguments) {
  command->add_option("--strokes", arguments.folders.strokes, "Folder with NAME/scene.toml")
      ->type_name("FOLDER")
      ->capture_default_str();
  command->add_option("--golden", arguments.folders.golden, "Folder of golden entries")
      ->type_name("FOLDER")
      ->capture_default_str();
}

}  // namespace

void add_golden_command(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<GoldenArguments>();
  CLI::App* golden = app.add_subcommand("golden", "Run scenes and compare them with their golden entries");
  golden->require_subcommand(1);
  golden->footer("Example:  sandstroke golden check --report differences --junit golden.xml");

  CLI::App* check_command =
      golden->add_subcommand("check", "Run all or some scenes and compare. Exit code 1: one differs");
  check_command->add_option("NAME", arguments->names, "Scenes (default: all)")->type_name("SCENE");
  add_folder_options(check_command, *arguments);
  add_tolerance_options(*check_command, arguments->tolerances, true);
  check_command
      ->add_option("--report", arguments->report,
                   "Folder for index.html, all scenes at a glance, and for a page, SCENE.html, per scene "
                   "that differs: checks, maps of the difference, forces")
      ->type_name("FOLDER");
  check_command->add_flag("--all-pages", arguments->all_pages,
                          "With --report: also pages of scenes that do not differ");
  check_command->add_option("--junit", arguments->junit, "File for the checks as JUnit XML")
      ->type_name("FILE.xml");
  check_command->add_flag("--json", arguments->json, "Print one JSON object instead of lines");
  check_command->footer(
      "Example:  sandstroke golden check wscg --force-tolerance 0.001\n"
      "A file tolerances.toml in the folder of a golden entry sets tolerances for that scene alone, with "
      "lines\n"
      "such as 'force = 0.001': height, force, depth, pixel, pixel_share, pixel_above. Options override "
      "them.");
  check_command->callback([arguments, &chosen] { chosen = [arguments] { return check(*arguments); }; });

  CLI::App* update_command =
      golden->add_subcommand("update", "Replace the golden entries of scenes by the scenes' present results");
  update_command->footer("Example:  sandstroke golden update wscg");
  update_command->add_option("NAME", arguments->names, "Scenes")->type_name("SCENE")->required();
  update_command->add_flag("--doubtful", arguments->doubtful,
                           "Also take a result for which a run ends with exit code 3");
  add_folder_options(update_command, *arguments);
  update_command->callback([arguments, &chosen] { chosen = [arguments] { return update(*arguments); }; });
}

}  // namespace sandstroke
