#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "sweep/slurm_script.h"

namespace sandstroke {

/// One task of a job array, and the points that it runs.
struct SlurmTask {
  int number = 1;  ///< I of shard I/N
  std::vector<std::size_t> points;
};

/// The jobs of a sweep's last submission: DIR/slurm/jobs.json.
struct SlurmJobs {
  long array = 0;    ///< the job array's id
  long collect = 0;  ///< the id of the job that collects; 0: there is none
  int of = 1;        ///< N of shard I/N
  std::vector<SlurmTask> tasks;
};

/// Reads jobs.json. None if the sweep was never submitted. Error: io, input.
std::optional<SlurmJobs> read_slurm_jobs(const std::filesystem::path& sweep_folder);

/// A line of Slurm's queue.
struct QueuedTask {
  long job = 0;  ///< the job's id, or its array's
  int task = 0;  ///< 0: the job is not an array
  std::string state;
  int restarts = 0;    ///< how many times it was requeued
  std::string reason;  ///< why it waits; empty: no reason

  /// True if it has not ended and may still run.
  bool alive() const;
  /// True if it waits until somebody releases it.
  bool held() const;
};

/// Parses squeue's output in queue_format. Skips other lines.
std::vector<QueuedTask> parse_queue(const std::string& text);

/// The jobs' tasks in the queue. None if squeue is missing or does not answer; `trouble` says why.
struct SlurmQueue {
  std::optional<std::vector<QueuedTask>> tasks;
  std::string trouble;
};
SlurmQueue ask_slurm_queue(const SlurmJobs& jobs);

/// How many tasks a cluster takes; none: it does not say.
struct SlurmLimits {
  std::optional<int> array_size;   ///< MaxArraySize: the numbers of tasks are below it
  std::optional<int> submit_jobs;  ///< MaxSubmitJobs, of the user's associations
  int queued = 0;                  ///< jobs of the user that are queued and count for submit_jobs

  /// The largest number of tasks beside the job that collects; at least 1.
  int most_tasks() const;
  /// "MaxArraySize = 1001"; empty: there is no limit.
  std::string text() const;
};
/// Asks scontrol, sacctmgr and squeue. What is missing or does not answer sets no limit.
SlurmLimits ask_slurm_limits();

/// sbatch refuses because of the number of tasks.
class TooManyTasks : public Error {
 public:
  explicit TooManyTasks(const std::string& sentence) : Error(ErrorKind::input, sentence) {}
};

/// Checks Slurm before anything is written. Error: io, if sbatch is not installed or no cluster answers.
void check_slurm();

/// Writes DIR/slurm/job.sh and collect.sh, submits both (collect.sh runs after job.sh) and writes jobs.json.
/// tasks: the tasks to submit; of: the number of all tasks. Error: input, if the sweep's last jobs are still
/// queued, or with sbatch's sentence if it refuses (TooManyTasks); io, if Slurm is missing or does not
/// answer.
SlurmJobs submit_to_slurm(const SlurmOptions& options, const SlurmWork& work, std::vector<SlurmTask> tasks,
                          int of);

}  // namespace sandstroke
