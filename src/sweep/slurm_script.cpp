#include "sweep/slurm_script.h"

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "core/shell_text.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); });
}

/// "#SBATCH --NAME=VALUE". Empty without a value.
std::string option_line(const std::string& name, const std::string& value) {
  if (has_control_character(value) || value.find_first_of(" '\"\\#") != std::string::npos)
    throw_input_error("{}: '{}' is not a single word without special characters; use sbatch's form", name,
                      value);
  return value.empty() ? "" : fmt::format("#SBATCH {}={}\n", name, value);
}

/// The lines that make jobs write to a file in DIR/slurm.
std::string log_lines(const SlurmWork& work, const std::string& name) {
  const std::string folder = (work.start / work.folder / "slurm").lexically_normal().string();
  if (has_control_character(folder) || folder.find_first_of("\"\\") != std::string::npos)
    throw_input_error(
        "{}: Slurm writes no logs into a folder whose name has quotes, backslashes or line breaks; choose "
        "another -o",
        folder);
  std::string escaped;  // Slurm replaces %j and the like by job ids
  for (const char c : folder) escaped += c == '%' ? std::string("%%") : std::string(1, c);
  return fmt::format("#SBATCH --output=\"{}/{}\"\n#SBATCH --open-mode=append\n", escaped, name);
}

std::string resource_lines(const SlurmOptions& options) {
  std::string text = option_line("--mem", options.memory) + option_line("--time", options.time) +
                     option_line("--partition", options.partition) +
                     option_line("--account", options.account);
  for (const std::string& line : options.lines) {
    if (line.empty() || line.front() != '-' || has_control_character(line))
      throw_input_error("--sbatch-option: '{}' is not an option of sbatch; give one like --qos=long", line);
    text += fmt::format("#SBATCH {}\n", line);
  }
  return text;
}

/// Quotes a file for a shell, so that no program takes it for an option.
std::string file_argument(const fs::path& file) {
  return shell_quoted(file.string().starts_with('-') ? fs::path(".") / file : file);
}

std::string command_line(const SlurmWork& work, const std::string& arguments) {
  return fmt::format("{} sweep {}", shell_quoted(work.program), arguments);
}

/// The line that goes where the sweep was submitted.
std::string folder_line(const SlurmWork& work) {
  return fmt::format("cd {} || exit\n", shell_quoted(work.start));
}

/// The lines that run the program, and queue the job again if its time ended and it had got on. Slurm tells
/// the shell, which tells the program: USR1 before the time ends, TERM where somebody cancels the job.
std::string requeued_lines(const SlurmWork& work, const std::string& arguments, int of) {
  const std::string folder = file_argument(work.folder);
  const std::string progress =
      fmt::format(R"({}/points/.shard-"$SLURM_ARRAY_TASK_ID"-of-{})", folder, of);  // touched by Sweep::run
  return folder_line(work) + fmt::format(R"(progress={}
started={}/slurm/"$SLURM_JOB_ID".started
touch "$progress" "$started"
{} &
program=$!
trap 'ended=$(date +%s); kill -USR1 $program' USR1
# Within half a minute behind USR1 it is somebody who cancels the job; then it is Slurm.
trap '[ "$ended" ] && [ $(($(date +%s) - ended)) -lt 25 ] && ended=; kill -TERM $program' TERM
wait $program
code=$?
while kill -0 $program 2> /dev/null; do wait $program; code=$?; done
if [ ! "$progress" -nt "$started" ]; then ended=; fi
rm -f "$started"
if [ "$ended" ] && [ $code -gt 128 ]; then scontrol requeue "$SLURM_JOB_ID"; fi
exit $code
)",
                                         progress, folder, command_line(work, arguments));
}

}  // namespace

int default_tasks(std::size_t simulations, int cpus_per_task) {
  const std::size_t each = 4 * static_cast<std::size_t>(cpus_per_task);
  return static_cast<int>(std::clamp<std::size_t>((simulations + each - 1) / each, 1, 1000));
}

std::string array_text(const std::vector<int>& tasks) {
  std::string text;
  for (std::size_t first = 0, last; first < tasks.size(); first = last + 1) {
    for (last = first; last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1;) ++last;
    if (first > 0) text += ',';
    text += last > first ? fmt::format("{}-{}", tasks[first], tasks[last]) : std::to_string(tasks[first]);
  }
  return text;
}

std::string array_script(const SlurmOptions& options, const SlurmWork& work, const std::vector<int>& tasks,
                         int of) {
  const std::string arguments =
      fmt::format(R"({} -o {} --shard "$SLURM_ARRAY_TASK_ID"/{} --jobs "$SLURM_CPUS_PER_TASK"{})",
                  file_argument(work.plan), file_argument(work.folder), of, options.arguments);
  return fmt::format(R"(#!/bin/sh
# Each task runs what is missing of its part of the sweep. A task whose time ends is queued again, and goes on.
#SBATCH --job-name=sandstroke
#SBATCH --array={}
#SBATCH --cpus-per-task={}
#SBATCH --requeue
#SBATCH --signal=B:USR1@30
{}{}{})",
                     array_text(tasks), options.cpus_per_task, log_lines(work, "%A_%a.log"),
                     resource_lines(options), requeued_lines(work, arguments, of));
}

std::string collect_script(const SlurmOptions& options, const SlurmWork& work) {
  return fmt::format(
      R"(#!/bin/sh
# Collects the sweep when its tasks have ended, however they did.
#SBATCH --job-name=sandstroke-collect
{}{}{})",
      log_lines(work, "collect_%j.log"), resource_lines(options),
      folder_line(work) + "exec " + command_line(work, "collect " + file_argument(work.folder)) + "\n");
}

}  // namespace sandstroke
