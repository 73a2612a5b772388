#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sandstroke {

/// A sweep's requests to a Slurm cluster.
struct SlurmOptions {
  int tasks = 0;                                 ///< number of tasks in the job array; 0: default_tasks()
  int cpus_per_task = 1;                         ///< simulations that a task runs at a time
  std::string memory, time, partition, account;  ///< in sbatch's format; empty: the cluster's defaults
  std::string arguments = {};      ///< for the sweep of each task, after its own: " --checkpoint 5"
  std::vector<std::string> lines;  ///< more options, written after #SBATCH in a script: "--qos=long"
};

/// The paths that jobs need, whatever folder they start in.
struct SlurmWork {
  std::filesystem::path program;  ///< this program; absolute
  std::filesystem::path start;    ///< the folder in which the user submitted; absolute
  std::filesystem::path plan;     ///< as the user named it
  std::filesystem::path folder;   ///< of the sweep, as the user named it
};

/// The number of tasks with which each runs four simulations per processor. At most 1000, which Slurm takes
/// by default (MaxArraySize: 1001).
int default_tasks(std::size_t simulations, int cpus_per_task);

/// Writes increasing task numbers for sbatch's --array: "1-3,7".
std::string array_text(const std::vector<int>& tasks);

/// The script of the job array. Task I runs the missing points of shard I/of. A task that Slurm requeues
/// goes on. Slurm signals a task half a minute before its time ends, and it stops.
/// Error: input, if an option or a folder's name cannot be written in a Slurm script.
std::string array_script(const SlurmOptions& options, const SlurmWork& work, const std::vector<int>& tasks,
                         int of);

/// The script of the job that collects the sweep when the array has ended.
std::string collect_script(const SlurmOptions& options, const SlurmWork& work);

}  // namespace sandstroke
