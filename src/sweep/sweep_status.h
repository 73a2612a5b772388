#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/table.h"
#include "sweep/slurm_jobs.h"
#include "sweep/sweep_folder.h"

namespace sandstroke {

/// What became of a submitted task: its points as the folder has them, its job as the queue has it.
struct TaskStatus {
  int number = 1;
  std::size_t points = 0, failed = 0, missing = 0;
  std::string state;  ///< done, pending, requeued, running, ..., gone; unknown: the queue was not to be asked
  bool alive = false;  ///< its job has not ended
  int restarts = 0;
  std::string reason;  ///< for its waiting
};

/// How far a sweep is.
struct SweepStatus {
  std::size_t points = 0, missing = 0;
  bool collected = false;  ///< sweep.h5 is there, and younger than every point
  VerdictCounts verdicts{};
  std::vector<std::pair<std::size_t, std::string>> failures;  ///< point and reason
  std::optional<long> array;                                  ///< the job array's id, where it was submitted
  std::vector<TaskStatus> tasks;                              ///< of it
  std::string queue_trouble;                                  ///< why the queue was not to be asked; or empty

  /// What is so, and what to do next.
  std::string advice() const;
};

/// Reads every point's file. jobs, queue: how it was submitted, if it was, and what Slurm says of that.
SweepStatus sweep_status(const SweepFolder& folder, const std::optional<SlurmJobs>& jobs,
                         const SlurmQueue& queue);

/// A row for each task that is not done.
Table open_tasks(const SweepStatus& status);

nlohmann::ordered_json as_json(const SweepStatus& status);

}  // namespace sandstroke
