#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sweep/slurm_script.h"

namespace sandstroke {

/// One task of a job array and the sweep's points that it is to run.
struct SlurmTask {
  int number = 1;  ///< I of shard I/N
  std::vector<std::size_t> points;
};

/// How a sweep was submitted last: DIR/slurm/jobs.json.
struct SlurmJobs {
  long array = 0;    ///< the job array's id
  long collect = 0;  ///< of the job that collects; 0: there is none
  int of = 1;        ///< N of shard I/N
  std::vector<SlurmTask> tasks;
};

/// None where the sweep was never submitted. Error: io, input.
std::optional<SlurmJobs> read_slurm_jobs(const std::filesystem::path& sweep_folder);

/// A line of Slurm's queue.
struct QueuedTask {
  long job = 0;  ///< of an array: the array's
  int task = 0;  ///< 0: the job is no array
  std::string state;
  int restarts = 0;    ///< how many times it was requeued
  std::string reason;  ///< for its waiting; empty: none

  /// Has not ended, and may yet run.
  bool alive() const;
  /// Waits until somebody releases it.
  bool held() const;
};

/// What squeue prints of jobs by queue_format. Lines that are no such thing are left out.
std::vector<QueuedTask> parse_queue(const std::string& text);

/// What the queue says of the jobs; none where squeue is not there or does not answer: why.
struct SlurmQueue {
  std::optional<std::vector<QueuedTask>> tasks;
  std::string trouble;
};
SlurmQueue ask_slurm_queue(const SlurmJobs& jobs);

/// Error: io, where sbatch is not installed or no cluster answers: for before anything is written.
void check_slurm();

/// Writes DIR/slurm/job.sh and collect.sh, submits them, the second after the first, and writes jobs.json.
/// tasks: those to submit, of so many. Error: input, where the sweep's last jobs are still queued, or sbatch
/// refuses (its sentence); io, where Slurm is not there or does not answer.
SlurmJobs submit_to_slurm(const SlurmOptions& options, const SlurmWork& work, std::vector<SlurmTask> tasks,
                          int of);

}  // namespace sandstroke
