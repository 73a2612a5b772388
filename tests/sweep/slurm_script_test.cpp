#include "sweep/slurm_script.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/child_process.h"
#include "core/error.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// The options that sbatch reads out of a script.
std::vector<std::string> option_lines(const std::string& script) {
  std::vector<std::string> options;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("#SBATCH ")) options.push_back(line.substr(8));
  return options;
}

testing::AssertionResult has(const std::vector<std::string>& lines, const std::string& line) {
  if (std::find(lines.begin(), lines.end(), line) != lines.end()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "no line '" << line << "'";
}

SlurmWork work_in(const fs::path& start) { return {"/opt/sandstroke", start, "plan.toml", "out"}; }

/// A script as a shell runs it: where the program is started, and with what words.
std::vector<std::string> started(const std::string& script, const fs::path& folder) {
  std::ofstream(folder / "job.sh") << script;
  setenv("SLURM_ARRAY_TASK_ID", "3", 1);
  setenv("SLURM_CPUS_PER_TASK", "2", 1);
  const auto result = run_child({"sh", (folder / "job.sh").string()});
  std::vector<std::string> words;
  std::istringstream lines(result->out);
  for (std::string line; std::getline(lines, line, '|');) words.push_back(line);
  return words;
}

/// Stands for sandstroke: says where it is and what it was given.
void write_program(const fs::path& path) {
  std::ofstream(path) << "#!/bin/sh\nprintf '%s|' \"$PWD\" \"$@\"\n";
  fs::permissions(path, fs::perms::owner_all);
}

TEST(SlurmScript, ATaskRunsItsShardWhereTheSweepWasSubmitted) {
  const TestFolder folder;
  // Names that a shell, or Slurm, would take for something else.
  for (const std::string name :
       {"plain", "two words", "$HOME", "it's", "a;touch gone", "%A_%a", "-o", "#", "*"}) {
    const fs::path start = folder / name;
    fs::create_directory(start);
    write_program(start / name);
    const SlurmWork work{start / name, start, name + ".toml", name};
    const auto words = started(array_script({}, work, {1, 2, 3}, 3), folder.path());
    const std::string dot = name == "-o" ? "./" : "";
    EXPECT_EQ(words, (std::vector<std::string>{start, "sweep", dot + name + ".toml", "-o", dot + name,
                                               "--shard", "3/3", "--jobs", "2"}))
        << name;
    EXPECT_EQ(started(collect_script({}, work), folder.path()),
              (std::vector<std::string>{start, "sweep", "collect", dot + name}))
        << name;
  }
}

TEST(SlurmScript, ATaskIsNotRunElsewhereWhereItsFolderIsGone) {
  const TestFolder folder;
  write_program(folder / "program");
  const SlurmWork work{folder / "program", folder / "gone", "plan.toml", "out"};
  EXPECT_TRUE(started(array_script({}, work, {1}, 1), folder.path()).empty());
}

TEST(SlurmScript, AsksForWhatTheOptionsSay) {
  SlurmOptions options;
  options.cpus_per_task = 4;
  options.memory = "4G";
  options.time = "1-02:00:00";
  options.partition = "long";
  options.account = "sand";
  options.lines = {"--qos=high", "--constraint=\"a&b\" --nice"};
  const auto lines = option_lines(array_script(options, work_in("/home/me"), {1, 2, 3, 7}, 9));
  for (const char* line :
       {"--array=1-3,7", "--cpus-per-task=4", "--mem=4G", "--time=1-02:00:00", "--partition=long",
        "--account=sand", "--qos=high", "--constraint=\"a&b\" --nice", "--requeue", "--open-mode=append",
        "--signal=B:USR1@30", "--output=\"/home/me/out/slurm/%A_%a.log\""})
    EXPECT_TRUE(has(lines, line));
}

TEST(SlurmScript, ATaskGetsWhatItsSweepWasAskedFor) {
  const TestFolder folder;
  write_program(folder / "program");
  SlurmOptions options;
  options.arguments = " --checkpoint 5";
  const SlurmWork work{folder / "program", folder.path(), "plan.toml", "out"};
  const auto words = started(array_script(options, work, {1}, 1), folder.path());
  ASSERT_GE(words.size(), 2u);
  EXPECT_EQ((std::vector<std::string>{words.end() - 2, words.end()}),
            (std::vector<std::string>{"--checkpoint", "5"}));
}

TEST(SlurmScript, WhatIsNotAskedForIsTheClusters) {
  for (const std::string& line : option_lines(array_script({}, work_in("/home/me"), {1}, 1)))
    for (const char* option : {"--mem", "--time", "--partition", "--account"})
      EXPECT_FALSE(line.starts_with(option)) << line;
}

TEST(SlurmScript, LogsAreWrittenIntoFoldersWithPercentSigns) {
  EXPECT_TRUE(has(option_lines(array_script({}, work_in("/home/100 % a"), {1}, 1)),
                  "--output=\"/home/100 %% a/out/slurm/%A_%a.log\""));
}

TEST(SlurmScript, RefusesWhatASlurmScriptCannotSay) {
  for (const char* folder : {"quote\"", "back\\slash", "line\nbreak"}) {
    SlurmWork work = work_in("/home/me");
    work.folder = folder;
    EXPECT_THROW(array_script({}, work, {1}, 1), Error) << folder;
    EXPECT_THROW(collect_script({}, work), Error) << folder;
  }
  for (const char* word : {"two words", "a\n#SBATCH --uid=0", "\"", "#"}) {
    SlurmOptions options;
    options.partition = word;
    EXPECT_THROW(array_script(options, work_in("/home/me"), {1}, 1), Error) << word;
  }
  for (const char* line : {"", "qos=high", "--qos=high\nrm -r ."}) {
    SlurmOptions options;
    options.lines = {line};
    EXPECT_THROW(array_script(options, work_in("/home/me"), {1}, 1), Error) << line;
  }
}

TEST(SlurmScript, TaskNumbersAreWrittenAsRanges) {
  EXPECT_EQ(array_text({5}), "5");
  EXPECT_EQ(array_text({1, 2}), "1-2");
  EXPECT_EQ(array_text({1, 3, 4, 5, 9}), "1,3-5,9");
}

TEST(SlurmScript, EveryProcessorOfEveryTaskHasSeveralSimulations) {
  EXPECT_EQ(default_tasks(1, 1), 1);
  EXPECT_EQ(default_tasks(100, 1), 25);
  EXPECT_EQ(default_tasks(100, 4), 7);
  EXPECT_EQ(default_tasks(1'000'000, 1), 1000);  // as many as Slurm takes
}

}  // namespace
}  // namespace sandstroke
