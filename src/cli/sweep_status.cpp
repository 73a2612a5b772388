#include "sweep/sweep_status.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <filesystem>

#include "cli/standard_output.h"
#include "cli/sweep_parts.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

void print(const SweepStatus& status, const fs::path& folder) {
  std::string verdicts;
  for (std::size_t i = 0; i < status.verdicts.size(); ++i)
    if (status.verdicts[i] > 0)
      verdicts +=
          fmt::format("{}{} {}", verdicts.empty() ? ": " : ", ", status.verdicts[i], verdict_names[i]);
  print_row("points", std::to_string(status.points));
  print_row("done", std::to_string(status.points - status.missing) + verdicts);
  print_row("missing", std::to_string(status.missing));
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; i < std::min(shown, status.failures.size()); ++i)
    print_row("failed", fmt::format("point {}: {}", status.failures[i].first, status.failures[i].second));
  if (status.failures.size() > shown)
    print_row("failed", fmt::format("and {} more", status.failures.size() - shown));

  if (status.array) {
    const Table open = open_tasks(status);
    print_row("tasks", fmt::format("{}, of which {} done; job array {}", status.tasks.size(),
                                   status.tasks.size() - open.rows(), *status.array));
    print_row("logs", (folder / "slurm").string());
    if (open.rows() > 0) print_text("\n{}\n", aligned_text(open));
  }
  print_row("next", status.advice());
}

int status_command(const SweepFolder& folder, bool json) {
  const std::optional<SlurmJobs> jobs = read_slurm_jobs(folder.path());
  const SweepStatus status = sweep_status(folder, jobs, jobs ? ask_slurm_queue(*jobs) : SlurmQueue{});
  if (json)
    print_json(as_json(status));
  else
    print(status, folder.path());
  return 0;
}

}  // namespace

void add_sweep_status_command(CLI::App& sweep, Command& chosen) {
  add_sweep_folder_command(
      sweep, "status", "Show the progress of a sweep and the next step",
      "Counts the points in the folder. For a sweep on Slurm it also shows the state of each task.\n"
      "Example:  sandstroke sweep status results",
      status_command, chosen);
}

}  // namespace sandstroke
