#include <spdlog/fmt/fmt.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "commands.h"
#include "compare/compare_page.h"
#include "compare/compare_runs.h"
#include "compare/junit.h"
#include "compare/report_picture.h"
#include "core/error.h"
#include "core/output_file.h"
#include "io/png_file.h"
#include "print_json.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

struct Options {
  fs::path golden, run;
  Tolerances tolerances;
  fs::path report, junit;
  bool json = false;
};

void write_page(const Options& options, const std::function<ComparePage()>& make) {
  if (options.report.empty()) return;
  make_folder(options.report);
  write_text_file(options.report / "compare.html", make().html());
}

Comparison compare_run_files(const Options& options) {
  const RunFile golden(options.golden), run(options.run);
  if (!options.report.empty()) {
    write_report(options.report / "height.png", [&] {
      return surface_report(options.run.string() + ": final height", golden.final(), run.final(),
                            golden.cell_size(), options.tolerances.height);
    });
  }
  Comparison comparison = compare_runs(golden, run, options.tolerances);
  write_page(options, [&] { return run_page(golden, run, comparison, options.tolerances); });
  return comparison;
}

Comparison compare_pictures(const Options& options) {
  const Image golden = read_png(options.golden), run = read_png(options.run);
  if (!options.report.empty()) {
    write_report(options.report / "picture.png",
                 [&] { return picture_report(options.run.string(), golden, run, options.tolerances.pixel); });
  }
  Comparison comparison{options.run.string(), {}};
  add_checks(comparison.checks, "picture", [&] { return picture_checks(golden, run, options.tolerances); });
  write_page(options, [&] {
    return picture_page(options.golden, golden, options.run, run, comparison, options.tolerances);
  });
  return comparison;
}

int compare(const Options& options) {
  if (has_picture_name(options.golden) != has_picture_name(options.run)) {
    throw_input_error(
        "{} and {}: one is a picture and the other is not; compare two run files or two PNG pictures",
        options.golden.string(), options.run.string());
  }
  if (!options.junit.empty()) check_output(options.junit, {options.golden, options.run});
  const Comparison comparison =
      has_picture_name(options.golden) ? compare_pictures(options) : compare_run_files(options);
  if (!options.junit.empty()) write_text_file(options.junit, junit_report({comparison}));
  if (options.json)
    print_json(to_json(comparison));
  else
    fmt::print("{}", check_table(comparison));
  return comparison.passed() ? 0 : 1;
}

}  // namespace

void add_compare_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("compare", "Compare two run files, or two PNG pictures");
  command->add_option("GOLDEN", options->golden, "What it should be: a run file or a PNG picture")
      ->type_name("FILE.h5|.png")
      ->required();
  command->add_option("RUN", options->run, "What came out: likewise")->type_name("FILE.h5|.png")->required();
  command->add_option("--height-tolerance", options->tolerances.height, "Height of any cell [m]")
      ->check(not_negative_number())
      ->capture_default_str();
  command->add_option("--force-tolerance", options->tolerances.force, "Force on the device in any tick [N]")
      ->check(not_negative_number())
      ->capture_default_str();
  command->add_option("--depth-tolerance", options->tolerances.depth, "Depth and sand level in any tick [m]")
      ->check(not_negative_number())
      ->capture_default_str();
  command->add_option("--pixel-tolerance", options->tolerances.pixel, "Any channel of any pixel [of 255]")
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
  command
      ->add_option("--pixel-share", options->tolerances.pixel_share, "Pixels that may differ at all [0 to 1]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--report", options->report,
                   "Folder for a page (compare.html: checks, maps, forces) and a picture of the difference")
      ->type_name("FOLDER");
  command->add_option("--junit", options->junit, "File for the checks as JUnit XML")->type_name("FILE.xml");
  command->add_flag("--json", options->json, "Print one JSON object instead of the table");
  command->footer(
      "Example:  sandstroke compare before.h5 after.h5 --report difference\n"
      "Exit code 1: they differ. Entries of golden/ are for sandstroke golden check.");
  command->callback([options, &chosen] { chosen = [options] { return compare(*options); }; });
}

}  // namespace sandstroke
