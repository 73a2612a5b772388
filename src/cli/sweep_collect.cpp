#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

#include "cli/standard_output.h"
#include "cli/sweep_parts.h"

namespace sandstroke {
namespace {

int collect_command(const SweepFolder& folder, bool json) {
  const CollectReport report = collect_sweep(folder, json);
  if (json)
    print_json(nlohmann::ordered_json{{"folder", folder.path().string()},
                                      {"points", folder.points()},
                                      {"done", report.done},
                                      {"failed", report.failed},
                                      {"missing", report.missing},
                                      {"unreadable", report.unreadable},
                                      {"surfaces_missing", report.surfaces_missing},
                                      {"content_hash", report.content_hash}});
  return 0;
}

}  // namespace

CollectReport collect_sweep(const SweepFolder& folder, bool json) {
  CollectReport report = collect(folder);
  for (const std::string& sentence : report.sentences) spdlog::warn("{}", sentence);
  if (!json) {
    print_row("collected",
              fmt::format("{} points done, {} failed, {} missing; content {}", report.done, report.failed,
                          report.missing + report.unreadable, report.content_hash));
    for (const char* name : {"sweep.html", "sweep.h5", "sweep.csv"})
      print_row("", (folder.path() / name).string());
  }
  return report;
}

void add_sweep_collect_command(CLI::App& sweep, Command& chosen) {
  add_sweep_folder_command(sweep, "collect",
                           "Collect the points of a sweep into sweep.html, sweep.h5 and sweep.csv",
                           "Collects the points that exist, also of an unfinished sweep.\n"
                           "A sweep that ends in one call collects by itself.\n"
                           "Example:  sandstroke sweep collect results",
                           collect_command, chosen);
}

}  // namespace sandstroke
