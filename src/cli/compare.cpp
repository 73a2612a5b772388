#include <spdlog/fmt/fmt.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/standard_output.h"
#include "cli/tolerance_options.h"
#include "compare/compare_runs.h"
#include "compare/junit.h"
#include "core/error.h"
#include "core/output_file.h"
#include "io/png_file.h"
#include "pages/compare_page.h"
#include "report/page.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

struct CompareArguments {
  fs::path golden, run;
  GivenTolerances given;
  fs::path report, junit;
  bool coarsen = false, json = false;
};

fs::path page_of(const CompareArguments& arguments) { return arguments.report / "compare.html"; }

void write_page(const CompareArguments& arguments, const std::function<PageOfParts()>& make) {
  if (!arguments.report.empty()) write_text_file(page_of(arguments), make().html(), page_output);
}

Comparison compare_run_files(const CompareArguments& arguments) {
  const RunFile golden(arguments.golden), run(arguments.run);
  const std::vector<UsedTolerance> used = used_tolerances(arguments.given);
  const Tolerances tolerances = values_of(used);
  Comparison comparison = compare_runs(golden, run, tolerances, arguments.coarsen);
  comparison.tolerances = used;
  write_page(arguments, [&] { return run_page(golden, run, comparison, tolerances, arguments.coarsen); });
  return comparison;
}

Comparison compare_pictures(const CompareArguments& arguments) {
  const Image golden = read_png(arguments.golden), run = read_png(arguments.run);
  Comparison comparison{arguments.run.string(), {}, used_tolerances(arguments.given)};
  const Tolerances tolerances = values_of(comparison.tolerances);
  add_checks(comparison.checks, "picture", [&] { return picture_checks(golden, run, tolerances); });
  write_page(arguments, [&] {
    return picture_page(arguments.golden, golden, arguments.run, run, comparison, tolerances);
  });
  return comparison;
}

int compare(const CompareArguments& arguments) {
  if (has_picture_name(arguments.golden) != has_picture_name(arguments.run)) {
    throw_input_error(
        "{} and {}: one is a picture and the other is not; compare two run files or two PNG pictures",
        arguments.golden.string(), arguments.run.string());
  }
  if (arguments.coarsen && has_picture_name(arguments.golden))
    throw_input_error("--coarsen: {} is a picture; leave out --coarsen, or compare two run files",
                      arguments.golden.string());
  std::vector<fs::path> files = {arguments.golden, arguments.run};
  if (!arguments.report.empty()) {
    make_folder(arguments.report);
    check_output(page_of(arguments), files, page_output);
    files.push_back(page_of(arguments));
  }
  if (!arguments.junit.empty()) check_output(arguments.junit, files, junit_output);
  const Comparison comparison =
      has_picture_name(arguments.golden) ? compare_pictures(arguments) : compare_run_files(arguments);
  if (!arguments.junit.empty()) write_text_file(arguments.junit, junit_report({comparison}), junit_output);
  if (arguments.json) {
    print_json(to_json(comparison));
  } else {
    print_text("{}", check_table(comparison));
    for (const Check& check : comparison.checks)
      if (arguments.coarsen && check.name == "cell size" && check.passed)
        print_text("cell size: {}\n", check.sentence);
    if (!arguments.report.empty()) print_text("page  {}\n", page_of(arguments).string());
    print_text("{}\n", verdict(comparison));
  }
  return comparison.passed() ? 0 : 1;
}

}  // namespace

void add_compare_command(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand("compare", "Compare two run files, or two PNG pictures");
  command->add_option("GOLDEN", arguments->golden, "Expected result: a run file or a PNG picture")
      ->type_name("FILE.h5|.png")
      ->required();
  command->add_option("RUN", arguments->run, "Result to check: a file of the same kind")
      ->type_name("FILE.h5|.png")
      ->required();
  add_tolerance_options(*command, arguments->given, false);
  command->add_flag("--coarsen", arguments->coarsen,
                    "Compare beds of the same size with different cells: average the finer bed over the "
                    "cells of the coarser one");
  command
      ->add_option("--report", arguments->report,
                   "Folder for a page, compare.html: checks, maps of the difference, forces")
      ->type_name("FOLDER");
  command->add_option("--junit", arguments->junit, "File for the checks as JUnit XML")->type_name("FILE.xml");
  command->add_flag("--json", arguments->json, "Print one JSON object instead of the table");
  command->footer(
      "Example:  sandstroke compare before.h5 after.h5 --report difference\n"
      "Exit code 1 says that they differ. To check entries of golden/, use sandstroke golden check.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return compare(*arguments); }; });
}

}  // namespace sandstroke
