#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/run_picture.h"
#include "cli/standard_output.h"
#include "core/error.h"
#include "core/output_file.h"
#include "pages/run_report.h"
#include "report/page.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

struct ReportArguments {
  fs::path run, output;
};

int report(const ReportArguments& arguments) {
  const RunFile run(arguments.run);
  const fs::path output = arguments.output.empty() ? beside(arguments.run, ".html") : arguments.output;
  if (const std::string ending = small_ending(output); ending != ".html" && ending != ".htm")
    throw_input_error("{}: is not a name for a page; end it with .html", output.string());
  check_output(output, {arguments.run}, page_output);
  const auto draw = [&](const LastSurface& last) {
    return RunPainter(run, run.scene().view).draw(last.surface);
  };
  write_text_file(output, run_report(run, draw, run.error_estimate()).html(), page_output);
  print_text("{}\n", output.string());
  return 0;
}

}  // namespace

void add_report_command(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand(
      "report", "Show a run on a page: picture, forces, energy, profiles of the sand, settings");
  command->add_option("RUN", arguments->run, "Run file (HDF5)")->type_name("FILE.h5")->required();
  command->add_option("-o,--output", arguments->output, "Page. Default: RUN.html, beside RUN")
      ->type_name("FILE.html");
  command->footer("Example:  sandstroke report wscg.h5");
  command->callback([arguments, &chosen] { chosen = [arguments] { return report(*arguments); }; });
}

}  // namespace sandstroke
