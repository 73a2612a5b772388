#include "stress/stress.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/output_file.h"
#include "core/progress.h"
#include "core/stopwatch.h"
#include "report/page.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path output = "stress";
  bool quick = false, json = false;
};

/// How many cases of each group ended how, and which surprised.
void print_summary(const StressReport& report) {
  std::vector<std::string> groups;
  for (const StressCase& one : report.cases)
    if (std::find(groups.begin(), groups.end(), one.group) == groups.end()) groups.push_back(one.group);
  const std::vector<Verdict> verdicts = {Verdict::stable,  Verdict::limit_cycle,   Verdict::diverged,
                                         Verdict::refused, Verdict::not_converged, Verdict::broken};
  fmt::print("{:<44}", "");
  for (const Verdict verdict : verdicts) fmt::print("{:>14}", name_of(verdict));
  fmt::print("{:>11}\n", "surprises");
  const auto row = [&](const std::string& name, const std::vector<Verdict>& seen, std::ptrdiff_t surprises) {
    fmt::print("{:<44}", name);
    for (const Verdict verdict : verdicts)
      fmt::print("{:>14}", std::count(seen.begin(), seen.end(), verdict));
    fmt::print("{:>11}\n", surprises);
  };
  for (const std::string& group : groups) {
    std::vector<Verdict> seen;
    std::ptrdiff_t surprises = 0;
    for (const StressCase& one : report.cases) {
      if (one.group != group) continue;
      seen.push_back(one.verdict);
      surprises += one.surprise();
    }
    row(group, seen, surprises);
  }
  for (const StabilityMap& map : report.maps) {
    std::vector<Verdict> seen;
    std::ptrdiff_t surprises = 0;
    for (const auto& verdicts_of_row : map.verdict)
      seen.insert(seen.end(), verdicts_of_row.begin(), verdicts_of_row.end());
    for (const auto& flags : map.surprise) surprises += std::count(flags.begin(), flags.end(), true);
    row("map: " + map.title, seen, surprises);
  }
  for (const StressCase& one : report.cases)
    if (one.surprise())
      spdlog::error("surprise: {}, {}: {} where {} was expected ({})", one.group, one.name,
                    name_of(one.verdict), one.expected.empty() ? "nothing" : name_of(one.expected.front()),
                    one.detail);
}

int stress(const Arguments& arguments) {
  const fs::path page = arguments.output / "stress.html";
  make_folder(arguments.output);
  check_output(page, {});
  Progress bar("stress");
  StressOptions options;
  options.quick = arguments.quick;
  options.progress = [&bar](double fraction) { bar.update(fraction); };
  const Stopwatch watch;
  const StressReport report = stress_all(options);
  if (interrupted()) return 128 + interrupted();

  nlohmann::ordered_json data = as_json(report);
  data["machine"] = describe_machine();
  data["quick"] = arguments.quick;
  data["seconds"] = watch.seconds();
  write_text_file(page, html_page("sandstroke stress: numerical stability", PageScript::stress, data));
  if (arguments.json) {
    fmt::print("{}\n", data.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print_summary(report);
    fmt::print("\nThe maps: {}\n", page.string());
  }
  return report.surprises() == 0 ? 0 : static_cast<int>(ErrorKind::unstable);
}

}  // namespace

void add_stress_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "stress", "Test numerical stability to the breaking point: device loop, relaxation, strokes");
  auto arguments = std::make_shared<Arguments>();
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for the page, stress.html, made where it is not there")
      ->capture_default_str();
  command->add_flag("--quick", arguments->quick,
                    "10 seconds rather than 7 minutes: coarser maps, fewer and shorter cases");
  command->add_flag("--json", arguments->json,
                    "Print the page's data as one JSON object instead of the table");
  command->footer(
      "Each case has an expected verdict; one that ends otherwise is a surprise, and the exit code is then "
      "3.\n"
      "Example:  sandstroke stress --quick -o out/stress");
  command->callback([arguments, &chosen] { chosen = [arguments] { return stress(*arguments); }; });
}

}  // namespace sandstroke
