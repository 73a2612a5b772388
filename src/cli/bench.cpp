#include <spdlog/fmt/fmt.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/plugin_options.h"
#include "cli/standard_output.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "validation/study/plugin_contenders.h"
#include "validation/study/study_files.h"
#include "validation/study/study_summary.h"
#include "validation/study/study_table.h"

namespace sandstroke {
namespace {

struct BenchArguments {
  StudyOptions study;
  std::filesystem::path folder = "bench";
  bool json = false;
  PluginOptions plugin;
};

int bench(const BenchArguments& arguments) {
  StudyOptions options = arguments.study;
  add_plugin_laws(options, arguments.plugin.laws());  // without a plugin: no laws, all problems
  const StudyFiles files(arguments.folder);
  catch_interrupts();
  std::optional<Progress> bar(std::in_place, "bench");
  options.progress = [&](double done) { bar->update(done); };
  const Study study = run_study(options);
  bar.reset();
  if (interrupted()) return 128 + interrupted();
  files.write(study);
  if (arguments.json)
    print_json(study_json(study));
  else
    print_text("{}\npage  {}\n", study_summary(study), files.page().string());
  return 0;
}

}  // namespace

void add_bench_command(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<BenchArguments>();
  std::vector<std::string> names;
  for (const ProblemMaker& maker : problem_makers()) names.emplace_back(maker.name);
  CLI::App* command =
      app.add_subcommand("bench", "Measure run time and error on problems with known answers");
  command->add_option("--scene", arguments->study.problems, "Run only this problem (repeatable)")
      ->allow_extra_args(false)
      ->check(CLI::IsMember(names));
  command
      ->add_option("-o,--output", arguments->folder,
                   "Folder for bench.html, bench.csv and bench.h5; it is made if it does not exist")
      ->type_name("FOLDER")
      ->capture_default_str();
  command->add_flag("--quick", arguments->study.quick,
                    "Take about 80 seconds, with coarser grids and shorter strokes");
  command
      ->add_option(
          "--repeats", arguments->study.repeats,
          "Number of times that each run is timed; the least time counts. Default: 5, with --quick 3")
      ->check(CLI::Range(1, 1000));
  command->add_option("--threads", arguments->study.threads, "Threads per run, unless the run varies them")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  arguments->plugin.add_to(*command,
                           "Plugin (.so) whose laws are measured beside the program's: in heaps, a stroke "
                           "and a plunge. Only these problems run, unless --scene names others");
  command->add_flag("--json", arguments->json,
                    "Print the page's data as one JSON object instead of the tables");
  command->footer("Example:  sandstroke bench --quick -o bench");
  command->callback([arguments, &chosen] { chosen = [arguments] { return bench(*arguments); }; });
}

}  // namespace sandstroke
