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

/// The state of a submitted task: its points in the folder, its job in the queue.
struct TaskStatus {
  int number = 1;
  std::size_t points = 0, failed = 0, missing = 0;
  std::string state;   ///< done, pending, requeued, running, ..., gone; unknown: the queue could not be asked
  bool alive = false;  ///< its job has not ended
  int restarts = 0;
  std::string reason;  ///< why it waits
};

/// The progress of a sweep.
struct SweepStatus {
  std::size_t points = 0, missing = 0;
  bool collected = false;  ///< sweep.h5 exists and is newer than every point
  VerdictCounts verdicts{};
  std::vector<std::pair<std::size_t, std::string>> failures;  ///< point and reason
  std::optional<long> array;                                  ///< the job array's id, if it was submitted
  std::vector<TaskStatus> tasks;                              ///< the array's tasks
  std::string queue_trouble;                                  ///< why the queue could not be asked, or empty
  std::string again, collect;                                 ///< commands that go on with it, or collect it

  /// Says how far the sweep is, and what to do next.
  std::string advice() const;
};

/// Reads every point's file. jobs: the submission, if any; queue: the jobs in Slurm's queue.
SweepStatus sweep_status(const SweepFolder& folder, const std::optional<SlurmJobs>& jobs,
                         const SlurmQueue& queue);

/// A table with a row for each task that is not done.
Table open_tasks(const SweepStatus& status);

nlohmann::ordered_json as_json(const SweepStatus& status);

}  // namespace sandstroke
