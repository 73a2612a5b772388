#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sandstroke {

/// What a sweep asks of a Slurm cluster.
struct SlurmOptions {
  int tasks = 0;                                 ///< of the job array; 0: default_tasks()
  int cpus_per_task = 1;                         ///< simulations that a task runs at a time
  std::string memory, time, partition, account;  ///< as sbatch takes them; empty: the cluster's own
  std::vector<std::string> lines;  ///< more options, as they stand after #SBATCH in a script: "--qos=long"
};

/// What the jobs are to do, whatever folder they start in.
struct SlurmWork {
  std::filesystem::path program;  ///< this one; absolute
  std::filesystem::path start;    ///< where the sweep was submitted; absolute
  std::filesystem::path plan;     ///< as the user named it
  std::filesystem::path folder;   ///< of the sweep, as the user named it
};

/// So many that each runs four simulations per processor; at most as many as Slurm allows unless it is
/// configured otherwise (MaxArraySize: 1000).
int default_tasks(std::size_t simulations, int cpus_per_task);

/// Task numbers in increasing order as sbatch's --array takes them: "1-3,7".
std::string array_text(const std::vector<int>& tasks);

/// The script of the job array: task I runs what is missing of shard I/of. A task that Slurm requeues starts
/// over and finds its points; one whose time runs out is told half a minute before, and stops. Error: input,
/// where an option or a folder's name cannot stand in a script of Slurm.
std::string array_script(const SlurmOptions& options, const SlurmWork& work, const std::vector<int>& tasks,
                         int of);

/// The script of the job that collects the sweep when the array has ended.
std::string collect_script(const SlurmOptions& options, const SlurmWork& work);

}  // namespace sandstroke
