#include "sweep/sweep_status.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/counted.h"
#include "core/shell_text.h"
#include "core/small_letters.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// Adds the queue's data to a task whose points are counted.
void add_queued(TaskStatus& task, const SlurmJobs& jobs, const SlurmQueue& queue) {
  task.state = task.missing == 0 ? "done" : queue.tasks ? "gone" : "unknown";
  if (!queue.tasks) return;
  const auto found = std::find_if(queue.tasks->begin(), queue.tasks->end(), [&](const QueuedTask& queued) {
    return queued.job == jobs.array && queued.task == task.number;
  });
  if (found == queue.tasks->end()) return;
  task.alive = found->alive();
  task.restarts = found->restarts;
  if (task.alive) {
    task.state = found->held()                                      ? "held"
                 : found->restarts > 0 && found->state == "PENDING" ? "requeued"
                                                                    : small_letters(found->state);
    task.reason = found->reason;
  } else if (task.missing > 0) {
    task.reason = small_letters(found->state);
  }
}

/// The command that goes on with the sweep, in words where the folder does not tell its plan.
std::string command_again(const SweepFolder& folder, bool on_slurm) {
  const std::string& plan = folder.manifest().plan;
  if (plan.empty()) return "run the same command again";
  return fmt::format("run sandstroke sweep {} -o {}{}", shell_quoted(plan), shell_quoted(folder.path()),
                     on_slurm ? " --slurm" : "");
}

bool is_collected(const SweepFolder& folder) {
  const fs::path file = folder.path() / "sweep.h5";
  if (!fs::exists(file)) return false;
  const fs::file_time_type collected = fs::last_write_time(file);
  for (std::size_t point = 0; point < folder.points(); ++point) {
    std::error_code missing;
    const fs::file_time_type written = fs::last_write_time(folder.point_file(point), missing);
    if (!missing && written > collected) return false;
  }
  return true;
}

}  // namespace

SweepStatus sweep_status(const SweepFolder& folder, const std::optional<SlurmJobs>& jobs,
                         const SlurmQueue& queue) {
  SweepStatus status;
  status.points = folder.points();
  status.again = command_again(folder, jobs.has_value());
  status.collect = "sandstroke sweep collect " + shell_quoted(folder.path());
  status.collected = is_collected(folder);
  std::vector<bool> point_missing(folder.points()), point_failed(folder.points());
  for (std::size_t point = 0; point < folder.points(); ++point) {
    const std::optional<PointResult> result = folder.read(point);
    point_missing[point] = !result;
    status.missing += !result;
    if (!result) continue;
    status.verdicts[static_cast<std::size_t>(result->verdict)] += 1;
    point_failed[point] = failed(result->verdict);
    if (point_failed[point]) status.failures.emplace_back(point, result->reason);
  }
  if (!jobs) return status;

  status.array = jobs->array;
  status.queue_trouble = queue.trouble;
  for (const SlurmTask& submitted : jobs->tasks) {
    TaskStatus task;
    task.number = submitted.number;
    task.points = submitted.points.size();
    for (const std::size_t point : submitted.points) {
      if (point >= folder.points()) continue;  // belongs to an earlier sweep in this folder
      task.missing += point_missing[point];
      task.failed += point_failed[point];
    }
    add_queued(task, *jobs, queue);
    status.tasks.push_back(std::move(task));
  }
  return status;
}

std::string SweepStatus::advice() const {
  if (missing == 0)
    return fmt::format("all points are done{}: {}",
                       failures.empty() ? "" : fmt::format(", but {} failed", failures.size()),
                       collected ? "sweep.html shows them" : "collect them with " + collect);
  if (!array) return fmt::format("{} missing: {}", counted(missing, "point"), again);
  if (!queue_trouble.empty())
    return fmt::format("{} missing, and the queue cannot be asked: {}; when nothing is queued, {}",
                       counted(missing, "point"), queue_trouble, again);
  std::size_t alive = 0, held = 0, gone = 0, left = 0;
  for (const TaskStatus& task : tasks) {
    alive += task.alive;
    held += task.state == "held";
    gone += !task.alive && task.missing > 0;
    left += task.alive ? 0 : task.missing;
  }
  if (held > 0)
    return fmt::format("{} held: scontrol release {}; or scancel {}, and {}", counted(held, "task"), *array,
                       *array, again);
  const std::string lost =
      fmt::format("{} gone and left {} point{}", counted(gone, "task"), left, left == 1 ? "" : "s");
  if (alive == 0) return (gone > 0 ? lost : counted(missing, "point") + " missing") + ": " + again;
  const std::string wait = counted(alive, "task") + " queued or running";
  return gone > 0 ? fmt::format("{}; {}: wait for the others, then {}", wait, lost, again) : wait + ": wait";
}

Table open_tasks(const SweepStatus& status) {
  std::vector<double> number, points, failed, missing, restarts;
  std::vector<std::string> state, reason;
  for (const TaskStatus& task : status.tasks) {
    if (task.state == "done") continue;
    number.push_back(task.number);
    points.push_back(static_cast<double>(task.points));
    failed.push_back(static_cast<double>(task.failed));
    missing.push_back(static_cast<double>(task.missing));
    state.push_back(task.state);
    restarts.push_back(task.restarts);
    reason.push_back(task.reason);
  }
  return {{{"task", "task", "", number},
           {"points", "points", "", points},
           {"failed", "failed", "", failed},
           {"missing", "missing", "", missing},
           {"state", "state", "", state},
           {"restarts", "restarts", "", restarts},
           {"reason", "reason", "", reason}}};
}

nlohmann::ordered_json as_json(const SweepStatus& status) {
  using Json = nlohmann::ordered_json;
  Json verdicts = Json::object(), failures = Json::array(), tasks = Json::array();
  for (std::size_t i = 0; i < status.verdicts.size(); ++i) verdicts[verdict_names[i]] = status.verdicts[i];
  for (const auto& [point, reason] : status.failures)
    failures.push_back({{"point", point}, {"reason", reason}});
  for (const TaskStatus& task : status.tasks)
    tasks.push_back({{"task", task.number},
                     {"points", task.points},
                     {"failed", task.failed},
                     {"missing", task.missing},
                     {"state", task.state},
                     {"alive", task.alive},
                     {"restarts", task.restarts},
                     {"reason", task.reason}});
  return {{"points", status.points},
          {"done", status.points - status.missing},
          {"failed", status.failures.size()},
          {"missing", status.missing},
          {"collected", status.collected},
          {"verdicts", verdicts},
          {"failures", failures},
          {"job_array", status.array ? Json(*status.array) : Json()},
          {"tasks", tasks},
          {"queue_trouble", status.queue_trouble},
          {"advice", status.advice()}};
}

}  // namespace sandstroke
