#pragma once

#include "cli/commands.h"
#include "sweep/collect.h"
#include "sweep/run_sweep.h"
#include "sweep/slurm_script.h"
#include "sweep/sweep_folder.h"

namespace sandstroke {

// The other tasks of `sweep`: `sweep status`, `sweep collect` and Slurm.

/// Adds a subcommand of `sweep` that takes a sweep's folder, and --json.
void add_sweep_folder_command(CLI::App& sweep, const char* name, const char* help, const char* footer,
                              int (*run)(const SweepFolder& folder, bool json), Command& chosen);
void add_sweep_status_command(CLI::App& sweep, Command& chosen);
void add_sweep_collect_command(CLI::App& sweep, Command& chosen);

/// Collects a sweep and prints the report (json: not on the standard output).
CollectReport collect_sweep(const SweepFolder& folder, bool json);

/// `sweep --slurm`, and the options for the cluster.
struct SlurmArguments {
  bool submit = false;
  SlurmOptions options;
};
void add_slurm_options(CLI::App& sweep, SlurmArguments& arguments);

/// Submits a task for each part of the sweep with missing points, and prints the jobs. Errors as in
/// submit_to_slurm.
int submit_sweep(const SlurmArguments& arguments, const std::filesystem::path& plan,
                 const SweepFolder& folder, const std::vector<PointGroup>& groups, bool json);

/// The script of the job array that submit_sweep() would submit for a new sweep of so many simulations, if
/// the cluster sets no limit. Writes and asks nothing. Error: input, as array_script().
std::string job_script(const SlurmArguments& arguments, const std::filesystem::path& plan,
                       const std::filesystem::path& folder, std::size_t simulations);

}  // namespace sandstroke
