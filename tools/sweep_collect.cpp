#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "sweep_parts.h"

namespace sandstroke {
namespace {

struct Arguments {
  std::filesystem::path folder;
  bool json = false;
};

int collect_command(const Arguments& arguments) {
  const SweepFolder folder = SweepFolder::open(arguments.folder);
  const CollectReport report = collect_sweep(folder, arguments.json);
  if (arguments.json)
    fmt::print("{}\n", nlohmann::ordered_json{{"folder", folder.path().string()},
                                              {"points", folder.points()},
                                              {"done", report.done},
                                              {"failed", report.failed},
                                              {"missing", report.missing},
                                              {"unreadable", report.unreadable},
                                              {"surfaces_missing", report.surfaces_missing},
                                              {"content_hash", report.content_hash}}
                           .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  return 0;
}

}  // namespace

CollectReport collect_sweep(const SweepFolder& folder, bool json) {
  CollectReport report = collect(folder);
  for (const std::string& sentence : report.sentences) spdlog::warn("{}", sentence);
  if (!json) {
    fmt::print("{:<12} {} points done, {} failed, {} missing; content {}\n", "collected", report.done,
               report.failed, report.missing + report.unreadable, report.content_hash);
    for (const char* name : {"sweep.html", "sweep.h5", "sweep.csv"})
      fmt::print("{:<12} {}\n", "", (folder.path() / name).string());
  }
  return report;
}

void add_sweep_collect_command(CLI::App& sweep, Command& chosen) {
  CLI::App* command = sweep.add_subcommand(
      "collect", "Put a sweep's points together: sweep.html, sweep.h5 and sweep.csv in its folder");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("FOLDER", arguments->folder, "Of the sweep: what -o named")->required();
  command->add_flag("--json", arguments->json, "Print the summary as one JSON object");
  command->footer(
      "Takes what is there, whether the sweep is complete or not; a sweep that ends in one call does it "
      "itself.\n"
      "Example:  sandstroke sweep collect results");
  command->callback([arguments, &chosen] { chosen = [arguments] { return collect_command(*arguments); }; });
}

}  // namespace sandstroke
