#include "sweep/slurm_jobs.h"

#include <pwd.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/child_process.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/json_count.h"
#include "core/output_file.h"
#include "sweep/sweep_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr OutputKind jobs_output{"a list of a sweep's jobs", "{\"format\":\"sandstroke.slurm\""};
constexpr OutputKind script_output{"a script of a sweep", "#!/bin/sh\n", "\n#SBATCH --job-name=sandstroke"};

constexpr const char* queue_format = "--Format=ArrayJobID:|,ArrayTaskID:|,State:|,RestartCnt:|,Reason:|";

fs::path jobs_path(const fs::path& sweep_folder) { return sweep_folder / "slurm" / "jobs.json"; }

void write_slurm_jobs(const fs::path& path, const SlurmJobs& jobs) {
  Json tasks = Json::array();
  for (const SlurmTask& task : jobs.tasks)
    tasks.push_back({{"number", task.number}, {"points", task.points}});
  write_text_file(path,
                  Json{{"format", "sandstroke.slurm"},
                       {"array", jobs.array},
                       {"collect", jobs.collect},
                       {"of", jobs.of},
                       {"tasks", tasks}}
                          .dump() +
                      "\n",
                  jobs_output);
}

/// The whole number at the start of a text, or `otherwise`.
template <class Number>
Number leading_number(const std::string& text, Number otherwise) {
  std::from_chars(text.data(), text.data() + text.size(), otherwise);
  return otherwise;
}

[[noreturn]] void fail_without_slurm() {
  throw_io_error("sbatch is not installed; submit from a machine with Slurm, or leave out --slurm");
}

/// Submits a script and returns the job's id.
long submit(const std::vector<std::string>& options, const fs::path& script) {
  std::vector<std::string> words = {"sbatch", "--parsable"};
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(fs::absolute(script).string());
  const std::optional<ChildResult> result = run_child(words);
  if (!result) fail_without_slurm();
  const long id = leading_number(result->out, 0L);  // "id", or "id;cluster"
  if (result->exit_code == 0 && id > 0) return id;
  const std::string sentence =
      fmt::format("Slurm did not take {}: {}", script.string(),
                  result->err.empty() ? "sbatch said nothing" : one_line(result->err));
  for (const char* reason :
       {"Invalid job array specification", "SubmitJobsLimit", "SubmitJobLimit", "job submit limit"})
    if (sentence.find(reason) != std::string::npos) throw TooManyTasks(sentence);
  throw_input_error("{}", sentence);
}

/// The numbers in the lines of a text that begin with `name` and, if it is not empty, "=".
std::vector<int> numbers_of(const std::string& text, const std::string& name) {
  std::vector<int> numbers;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(name)) continue;
    const auto digits = line.find_first_of("0123456789", name.size());
    if (digits != std::string::npos) numbers.push_back(leading_number(line.substr(digits), 0));
  }
  return numbers;
}

/// What a program prints; empty, if it is missing or fails.
std::string printed_by(const std::vector<std::string>& words) {
  const std::optional<ChildResult> result = run_child(words);
  return result && result->exit_code == 0 ? result->out : "";
}

/// Refuses to submit while the last jobs are queued: Slurm would run the same points twice.
void refuse_if_alive(const fs::path& sweep_folder) {
  const std::optional<SlurmJobs> last = read_slurm_jobs(sweep_folder);
  if (!last) return;
  const SlurmQueue queue = ask_slurm_queue(*last);
  if (!queue.tasks)
    throw_io_error(
        "it is unknown whether the sweep's last jobs are still queued: {}; try again later, or leave out "
        "--slurm to run it here",
        queue.trouble);
  const auto alive = std::count_if(queue.tasks->begin(), queue.tasks->end(),
                                   [](const QueuedTask& task) { return task.alive(); });
  if (alive > 0)
    throw_input_error(
        "{}: was already submitted, and {} of its jobs {} still queued; wait for them, or cancel them: "
        "scancel {} {}",
        sweep_folder.string(), alive, alive == 1 ? "is" : "are", last->array,
        last->collect ? std::to_string(last->collect) : "");
}

}  // namespace

std::optional<SlurmJobs> read_slurm_jobs(const fs::path& sweep_folder) {
  const fs::path path = jobs_path(sweep_folder);
  if (!fs::exists(path)) return std::nullopt;
  try {
    const Json json = Json::parse(read_text_file(path, most_note_bytes));
    SlurmJobs jobs{json_count<long>(json.at("array")),
                   json_count<long>(json.at("collect")),
                   json_count<int>(json.at("of")),
                   {}};
    for (const Json& task : json.at("tasks")) {
      SlurmTask& submitted = jobs.tasks.emplace_back();
      submitted.number = json_count<int>(task.at("number"));
      for (const Json& point : task.at("points")) submitted.points.push_back(json_count<std::size_t>(point));
    }
    return jobs;
  } catch (const Json::exception&) {
    throw_input_error("{}: is damaged; check with squeue what is queued, then remove the file",
                      path.string());
  }
}

bool QueuedTask::alive() const {
  static const std::vector<std::string> ended = {"BOOT_FAIL",     "CANCELLED", "COMPLETED", "DEADLINE",
                                                 "FAILED",        "NODE_FAIL", "PREEMPTED", "REVOKED",
                                                 "OUT_OF_MEMORY", "TIMEOUT"};
  return std::find(ended.begin(), ended.end(), state) == ended.end();
}

bool QueuedTask::held() const {  // JobHeldUser, launch_failed_requeued_held, ...
  return alive() && (reason.find("Held") != std::string::npos || reason.find("held") != std::string::npos);
}

std::vector<QueuedTask> parse_queue(const std::string& text) {
  std::vector<QueuedTask> tasks;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream rest(line);
    for (std::string field; std::getline(rest, field, '|');) fields.push_back(field);
    const long job = fields.size() >= 5 ? leading_number(fields[0], 0L) : 0;
    if (job > 0)
      tasks.push_back({job, leading_number(fields[1], 0), fields[2], leading_number(fields[3], 0),
                       fields[4] == "None" ? "" : fields[4]});
  }
  return tasks;
}

SlurmQueue ask_slurm_queue(const SlurmJobs& jobs) {
  // Asked for one forgotten job, squeue fails; asked for two, it lists what it knows. So name two.
  const std::optional<ChildResult> result = run_child(
      {"squeue", "--noheader", "--array", "--states=all",
       fmt::format("--jobs={},{}", jobs.array, jobs.collect ? jobs.collect : jobs.array), queue_format});
  if (!result) return {std::nullopt, "squeue is not installed"};
  if (result->exit_code != 0) return {std::nullopt, one_line(result->err)};
  return {parse_queue(result->out), ""};
}

void check_slurm() {
  if (!run_child({"sbatch", "--version"})) fail_without_slurm();
  const std::optional<ChildResult> queue = run_child({"squeue", "--noheader", "--me"});
  if (queue && queue->exit_code != 0)
    throw_io_error("no cluster answers ({}); submit from a machine with Slurm, or leave out --slurm",
                   one_line(queue->err));
}

int SlurmLimits::most_tasks() const {
  int most = std::numeric_limits<int>::max();
  if (array_size) most = std::min(most, *array_size - 1);
  if (submit_jobs) most = std::min(most, *submit_jobs - queued - 1);
  return std::max(most, 1);
}

std::string SlurmLimits::text() const {
  std::vector<std::string> limits;
  if (array_size) limits.push_back(fmt::format("MaxArraySize = {}", *array_size));
  if (submit_jobs) limits.push_back(fmt::format("MaxSubmitJobs = {}, {} queued", *submit_jobs, queued));
  return fmt::format("{}", fmt::join(limits, ", "));
}

SlurmLimits ask_slurm_limits() {
  SlurmLimits limits;
  const std::vector<int> sizes = numbers_of(printed_by({"scontrol", "show", "config"}), "MaxArraySize");
  if (!sizes.empty()) limits.array_size = sizes.front();
  const passwd* user = getpwuid(geteuid());
  if (!user) return limits;
  const std::vector<int> most =
      numbers_of(printed_by({"sacctmgr", "--noheader", "--parsable2", "show", "associations", "where",
                             fmt::format("user={}", user->pw_name), "format=MaxSubmitJobs"}),
                 "");
  if (most.empty()) return limits;
  limits.submit_jobs = *std::min_element(most.begin(), most.end());
  const std::string queue = printed_by({"squeue", "--noheader", "--me", "--array", "--format=%i"});
  limits.queued = static_cast<int>(std::count(queue.begin(), queue.end(), '\n')) + !queue.empty();
  return limits;
}

SlurmJobs submit_to_slurm(const SlurmOptions& options, const SlurmWork& work, std::vector<SlurmTask> tasks,
                          int of) {
  const fs::path sweep_folder = work.start / work.folder, folder = sweep_folder / "slurm";
  refuse_if_alive(sweep_folder);
  std::vector<int> numbers;
  for (const SlurmTask& task : tasks) numbers.push_back(task.number);
  refuse_link(folder);
  make_folder(folder);
  write_text_file(folder / "job.sh", array_script(options, work, numbers, of), script_output);
  write_text_file(folder / "collect.sh", collect_script(options, work), script_output);

  SlurmJobs jobs{submit({}, folder / "job.sh"), 0, of, std::move(tasks)};
  write_slurm_jobs(jobs_path(sweep_folder), jobs);
  try {
    jobs.collect = submit({fmt::format("--dependency=afterany:{}", jobs.array)}, folder / "collect.sh");
    write_slurm_jobs(jobs_path(sweep_folder), jobs);
  } catch (const Error& refused) {
    spdlog::warn(
        "the sweep's tasks are queued, but nothing will collect them: {}; when they have ended, run: "
        "sandstroke sweep collect {}",
        refused.what(), work.folder.string());
  }
  return jobs;
}

}  // namespace sandstroke
