#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "cli/standard_output.h"
#include "cli/sweep_parts.h"
#include "sweep/slurm_jobs.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// The parts of the sweep with missing points.
std::vector<SlurmTask> tasks_to_do(const SweepFolder& folder, const std::vector<PointGroup>& groups, int of) {
  std::vector<SlurmTask> tasks;
  for (int number = 1; number <= of; ++number) {
    SlurmTask task{number, {}};
    bool open = false;
    for (const PointGroup& group : Shard{number, of}.among(groups))
      for (const std::size_t point : group) {
        task.points.push_back(point);
        open = open || !folder.read(point);
      }
    if (open) tasks.push_back(std::move(task));
  }
  return tasks;
}

int task_count(const SlurmOptions& options, std::size_t simulations) {
  return options.tasks > 0 ? std::min(options.tasks, static_cast<int>(simulations))
                           : default_tasks(simulations, options.cpus_per_task);
}

SlurmWork work_of(const fs::path& plan, const fs::path& folder) {
  return {fs::read_symlink("/proc/self/exe"), fs::current_path(), plan, folder};
}

/// Submits a task for each of `of` parts; half as many, while the cluster refuses their number.
SlurmJobs submit_or_halve(const SlurmOptions& options, const SlurmWork& work, const SweepFolder& folder,
                          const std::vector<PointGroup>& groups, int of) {
  while (true) {
    try {
      return submit_to_slurm(options, work, tasks_to_do(folder, groups, of), of);
    } catch (const TooManyTasks& refused) {
      if (of == 1) throw;
      spdlog::info("{}: tries {} tasks instead of {}", refused.what(), of / 2, of);
      of /= 2;
    }
  }
}

}  // namespace

void add_slurm_options(CLI::App& sweep, SlurmArguments& arguments) {
  SlurmOptions& options = arguments.options;
  CLI::Option* slurm = sweep.add_flag(
      "--slurm", arguments.submit,
      "Submit the missing points to a Slurm cluster as a job array. See sandstroke sweep status");
  const auto add = [&](const char* name, auto& value, const char* text) {
    return sweep.add_option(name, value, text)->needs(slurm)->group("With --slurm");
  };
  add("--tasks", options.tasks,
      "Number of tasks of the job array. Default: 4 simulations per core. Never more than the cluster takes")
      ->check(CLI::Range(1, 1000000));
  add("--cpus-per-task", options.cpus_per_task, "Cores per task. A task runs that many simulations at once")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  add("--mem", options.memory, "Memory per task in sbatch's format, such as 4G");
  add("--time", options.time, "Time limit per task: 2:00:00");
  add("--partition", options.partition, "Slurm partition");
  add("--account", options.account, "Slurm account");
  add("--sbatch-option", options.lines, "Another option of sbatch, for example \"--qos=long\" (repeatable)")
      ->allow_extra_args(false);
}

int submit_sweep(const SlurmArguments& arguments, const fs::path& plan, const SweepFolder& folder,
                 const std::vector<PointGroup>& groups, bool json) {
  const SlurmOptions& options = arguments.options;
  int of = task_count(options, groups.size());
  const SlurmLimits limits = ask_slurm_limits();
  if (const int most = limits.most_tasks(); of > most) {
    spdlog::info("{} tasks instead of {}, because the cluster takes no more ({})", most, of, limits.text());
    of = most;
  }
  if (tasks_to_do(folder, groups, of).empty()) {
    if (json)
      print_json(nlohmann::ordered_json{{"folder", folder.path().string()}, {"tasks", 0}});
    else
      print_text("all points are done: sandstroke sweep collect {}\n", folder.path().string());
    return 0;
  }
  const SlurmJobs jobs = submit_or_halve(options, work_of(plan, folder.path()), folder, groups, of);
  if (json)
    print_json(nlohmann::ordered_json{{"folder", folder.path().string()},
                                      {"tasks", jobs.tasks.size()},
                                      {"array", jobs.array},
                                      {"collect", jobs.collect}});
  else
    print_text(
        "submitted job array {} of {} tasks, and job {} to collect them\n"
        "sandstroke sweep status {}\n",
        jobs.array, jobs.tasks.size(), jobs.collect, folder.path().string());
  return 0;
}

std::string job_script(const SlurmArguments& arguments, const fs::path& plan, const fs::path& folder,
                       std::size_t simulations) {
  const int of = task_count(arguments.options, simulations);
  std::vector<int> numbers(static_cast<std::size_t>(of));
  std::iota(numbers.begin(), numbers.end(), 1);
  return array_script(arguments.options, work_of(plan, folder), numbers, of);
}

}  // namespace sandstroke
