#pragma once

#include "commands.h"
#include "sweep/run_sweep.h"
#include "sweep/slurm_script.h"
#include "sweep/sweep_folder.h"

namespace sandstroke {

// What `sweep` does besides sweeping; the first adds `sweep status`.

void add_sweep_status_command(CLI::App& sweep, Command& chosen);

/// `sweep --slurm`, and the options that say what to ask of the cluster.
struct SlurmArguments {
  bool submit = false;
  SlurmOptions options;
};
void add_slurm_options(CLI::App& sweep, SlurmArguments& arguments);

/// Submits a task for each part of the sweep that has points missing, and says so. Error: as submit_to_slurm.
int submit_sweep(const SlurmArguments& arguments, const std::filesystem::path& plan,
                 const SweepFolder& folder, const std::vector<PointGroup>& groups, bool json);

}  // namespace sandstroke
