// Sweeps on a real cluster: tests/slurm/cluster runs this program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/program.h"
#include "core/child_process.h"
#include "hdf5/hdf5_reader.h"
#include "sweep/slurm_jobs.h"
#include "sweep/sweep_folder.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

const std::string cluster = std::getenv("SANDSTROKE_CLUSTER") ? std::getenv("SANDSTROKE_CLUSTER") : "";

/// Asks again and again. The bound only ends what would never come.
template <class Condition>
bool comes_true(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

/// The program that a task of an array runs in this cluster; 0: there is none.
pid_t process_of(long array, int task) {
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::error_code gone;
    if (fs::read_symlink(entry.path() / "exe", gone) != fs::canonical(SANDSTROKE_PROGRAM)) continue;
    const std::string environment = '\0' + read_file(entry.path() / "environ");
    const auto has = [&](const std::string& variable) {
      return environment.find('\0' + variable + '\0') != std::string::npos;
    };
    if (has("SANDSTROKE_CLUSTER=" + cluster) && has("SLURM_ARRAY_JOB_ID=" + std::to_string(array)) &&
        has("SLURM_ARRAY_TASK_ID=" + std::to_string(task)))
      return std::stoi(name);
  }
  return 0;
}

int slurm(const std::vector<std::string>& words) {
  const auto result = run_child(words);
  EXPECT_TRUE(result && result->exit_code == 0) << words[0] << ": " << (result ? result->err : "not there");
  return result ? result->exit_code : -1;
}

bool same_bits(const double* a, const double* b, Eigen::Index count) {
  return std::memcmp(a, b, static_cast<std::size_t>(count) * sizeof(double)) == 0;
}

/// One plan, of twelve simulations for 24 points, swept into a folder per test.
class SweepOnSlurm : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ASSERT_NE(cluster, "") << "run this program by tests/slurm/cluster";
    suite = std::make_unique<TestFolder>();
    folder = suite->path();
    write_file(folder / "scene.toml",
               "[bed]\nsize = [0.4, 0.3]\ncells = [400, 300]\n[stroke]\nfile = \"line.toml\"\n");
    write_file(folder / "line.toml",
               "start = [-0.1, 0.0]\nspeed = 0.03\n[[segment]]\nkind = \"line\"\nto = [0.1, 0.0]\ndepth = "
               "0.006\n");
    write_file(
        folder / "plan.toml",
        "[sweep]\nscene = \"scene.toml\"\nkeep = [\"surface\"]\n[axes]\nrelaxation.talus_angle = { from = "
        "20, to = 42, count = 12 }\nforce.k_s = [500, 1000]\n");
    ASSERT_EQ(sweep({"plan.toml", "-o", "local"}).exit_code, 0);
  }
  static void TearDownTestSuite() { suite.reset(); }

  static ProgramResult sweep(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "sweep");
    return run_program(arguments, folder);
  }
  /// Submits it and says with which jobs.
  static SlurmJobs submit(const std::string& output, const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"plan.toml", "-o", output, "--slurm"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = sweep(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_slurm_jobs(folder / output).value_or(SlurmJobs{});
  }
  static nlohmann::json status(const std::string& output) {
    return nlohmann::json::parse(sweep({"status", output, "--json"}).out, nullptr, false);
  }
  static bool some_point_done(const std::string& output, const SlurmTask& task) {
    const SweepFolder swept = SweepFolder::open(folder / output);
    return std::any_of(task.points.begin(), task.points.end(),
                       [&](std::size_t point) { return fs::exists(swept.point_file(point)); });
  }
  /// No job of it is left in the queue.
  static bool ended(const SlurmJobs& jobs) {
    const SlurmQueue queue = ask_slurm_queue(jobs);
    return queue.tasks && std::none_of(queue.tasks->begin(), queue.tasks->end(),
                                       [](const QueuedTask& task) { return task.alive(); });
  }
  static std::string logs(const std::string& output) {
    std::string text;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / output / "slurm"))
      if (entry.path().extension() == ".log")
        text += entry.path().filename().string() + ":\n" + read_file(entry.path());
    return text;
  }

  /// Every bit of every point is as a sweep on this machine has it.
  static void expect_as_local(const std::string& output) {
    const SweepFolder local = SweepFolder::open(folder / "local"), other = SweepFolder::open(folder / output);
    for (std::size_t point = 0; point < local.points(); ++point) {
      const auto expected = local.read(point), result = other.read(point);
      ASSERT_TRUE(result) << "point " << point << " is missing; the tasks' logs:\n" << logs(output);
      EXPECT_EQ(result->verdict, expected->verdict);
      for (std::size_t i = 0; i < local.metrics().size(); ++i) {
        const bool same =
            local.metrics()[i].timing || same_bits(&result->metrics[i], &expected->metrics[i], 1);
        EXPECT_TRUE(same) << local.metrics()[i].name << " of point " << point;
      }
      const HeightGrid surface = Hdf5Reader(other.surface_file(point)).grid("/surface"),
                       there = Hdf5Reader(local.surface_file(point)).grid("/surface");
      ASSERT_EQ(surface.size(), there.size());
      EXPECT_TRUE(same_bits(surface.data(), there.data(), surface.size())) << "surface of point " << point;
    }
  }

  static inline std::unique_ptr<TestFolder> suite;
  static inline fs::path folder;
};

TEST_F(SweepOnSlurm, AnArrayGivesWhatALocalSweepGives) {
  const std::string output = "it's 100 %A; $x";  // which sbatch and shells would take for something else
  const ProgramResult refused = sweep({"plan.toml", "-o", output, "--slurm", "--partition", "nowhere"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("invalid partition specified: nowhere"), std::string::npos) << refused.err;

  const SlurmJobs jobs =
      submit(output, {"--tasks", "3", "--time", "10", "--sbatch-option", "--comment=\"two words\""});
  ASSERT_EQ(jobs.tasks.size(), 3u);
  const ProgramResult again = sweep({"plan.toml", "-o", output, "--slurm"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("was already submitted"), std::string::npos) << again.err;
  EXPECT_TRUE(comes_true([&] { return ended(jobs); }));
  expect_as_local(output);
  EXPECT_EQ(status(output)["missing"], 0);
  for (const SlurmTask& task : jobs.tasks)
    EXPECT_TRUE(fs::exists(folder / output / "slurm" / fmt::format("{}_{}.log", jobs.array, task.number)));

  // The last job has collected it.
  ASSERT_TRUE(fs::exists(folder / output / "sweep.h5")) << logs(output);
  EXPECT_EQ(sweep({"collect", "local"}).exit_code, 0);
  EXPECT_EQ(Hdf5Reader(folder / output / "sweep.h5").text_attribute("/", "content_hash"),
            Hdf5Reader(folder / "local" / "sweep.h5").text_attribute("/", "content_hash"));

  const ProgramResult done = sweep({"plan.toml", "-o", output, "--slurm"});
  EXPECT_NE(done.out.find("all points are done"), std::string::npos) << done.err;
  EXPECT_EQ(read_slurm_jobs(folder / output)->array, jobs.array);
}

TEST_F(SweepOnSlurm, KilledTasksAreRequeuedOrRunAgain) {
  const SlurmJobs jobs = submit("killed", {"--tasks", "2"});
  ASSERT_EQ(jobs.tasks.size(), 2u);
  ASSERT_TRUE(comes_true(
      [&] { return some_point_done("killed", jobs.tasks[0]) && some_point_done("killed", jobs.tasks[1]); }));
  // The first is requeued: Slurm lets such a task wait for two minutes, unless told otherwise.
  const std::string first = std::to_string(jobs.array) + "_1";
  slurm({"scontrol", "requeue", first});
  const pid_t second = process_of(jobs.array, 2);
  ASSERT_GT(second, 0);
  kill(second, SIGKILL);
  nlohmann::json killed;
  ASSERT_TRUE(comes_true([&] {
    killed = status("killed");
    return killed["tasks"][0]["state"] == "requeued" && killed["tasks"][1]["state"] == "gone";
  })) << killed;
  EXPECT_GT(killed["tasks"][0]["missing"], 0);
  EXPECT_GT(killed["tasks"][1]["missing"], 0);
  slurm({"scontrol", "update", "JobId=" + first, "StartTime=now+2"});
  EXPECT_TRUE(comes_true([&] { return ended(jobs); }));
  EXPECT_EQ(status("killed")["tasks"][0]["state"], "done") << logs("killed");
  EXPECT_EQ(status("killed")["advice"].get<std::string>().find("1 task is gone and left "), 0u);

  const SlurmJobs rest = submit("killed", {"--tasks", "2"});
  ASSERT_EQ(rest.tasks.size(), 1u);
  EXPECT_EQ(rest.tasks[0].number, 2);
  EXPECT_TRUE(comes_true([&] { return ended(rest); }));
  expect_as_local("killed");
}

/// Slurm tells a task so half a minute before its time ends; here the signal comes from scancel.
TEST_F(SweepOnSlurm, ATaskWhoseTimeEndsIsQueuedAgainAndGoesOn) {
  const SlurmJobs jobs = submit("ended", {"--tasks", "1"});
  ASSERT_TRUE(comes_true([&] { return some_point_done("ended", jobs.tasks[0]); }));
  const std::string task = std::to_string(jobs.array) + "_1";
  slurm({"scancel", "--batch", "--signal=USR1", task});
  ASSERT_TRUE(comes_true([&] { return status("ended")["tasks"][0]["state"] == "requeued"; }))
      << logs("ended");
  EXPECT_GT(status("ended")["missing"], 0);
  slurm({"scontrol", "update", "JobId=" + task, "StartTime=now+2"});
  EXPECT_TRUE(comes_true([&] { return ended(jobs); }));
  EXPECT_EQ(status("ended")["tasks"][0]["state"], "done") << logs("ended");
  expect_as_local("ended");
}

// Apptainer is not in Debian. One that runs this program, where the image's would be run, takes its place.
TEST_F(SweepOnSlurm, TheJobForImagesSweepsAPartInEachTask) {
  const fs::path apptainer = folder / "bin" / "apptainer";
  fs::create_directory(folder / "bin");
  write_file(apptainer, fmt::format("#!/bin/sh -e\n"
                                    "[ \"$1 $2 $4 $6 $7\" = 'exec --bind --pwd sandstroke.sif sandstroke' ]\n"
                                    "[ \"$3\" = \"$5\" ]\n"
                                    "cd \"$5\"\nshift 7\n'{}' \"$@\"\n",
                                    SANDSTROKE_PROGRAM));
  fs::permissions(apptainer, fs::perms::owner_all);
  const auto submit_array = [&](const std::string& array) {
    const auto result =
        run_child({"env", "PATH=" + apptainer.parent_path().string() + ":" + std::getenv("PATH"), "sbatch",
                   "--wait", "--mem=1",  // MB: the cluster's node does not say how much it has
                   "--array=" + array, "--chdir=" + folder.string(), "--output=image-%a.log",
                   SANDSTROKE_SOURCE "/tools/container/sweep.sbatch", "plan.toml", "in-image"});
    return result ? result->exit_code : -1;
  };
  /// How many of the three tasks said that.
  const auto tasks_with = [&](const std::string& points) {
    int count = 0;
    for (const int task : {1, 2, 3})
      count += read_file(folder / fmt::format("image-{}.log", task)).find(points) != std::string::npos;
    return count;
  };
  // Some tasks of an array alone would take other parts.
  EXPECT_EQ(submit_array("1,3"), 2);
  EXPECT_THAT(read_file(folder / "image-3.log"), testing::HasSubstr("the same N each time"));
  EXPECT_FALSE(fs::exists(folder / "in-image"));

  EXPECT_EQ(submit_array("1-3"), 0);
  EXPECT_EQ(tasks_with("8: 8 run now, 0 before"), 3);
  expect_as_local("in-image");

  fs::remove(SweepFolder::open(folder / "in-image").point_file(7));
  EXPECT_EQ(submit_array("1-3"), 0);
  EXPECT_EQ(tasks_with("8: 1 run now, 7 before"), 1);
  EXPECT_EQ(tasks_with("8: 0 run now, 8 before"), 2);
  expect_as_local("in-image");
  EXPECT_EQ(sweep({"collect", "in-image"}).exit_code, 0);
}

// The last test: the controller that is started again may take tasks for running that have ended, and their
// processors for taken.
TEST_F(SweepOnSlurm, WhatAKilledControllerLeavesIsFinishedHere) {
  const SlurmJobs jobs = submit("orphaned", {"--tasks", "4"});
  ASSERT_TRUE(comes_true([&] { return some_point_done("orphaned", jobs.tasks[0]); }));
  kill(std::stoi(read_file(cluster + "/slurmctld.pid")), SIGKILL);
  EXPECT_EQ(sweep({"plan.toml", "-o", "orphaned"}).exit_code, 0);
  expect_as_local("orphaned");
  const nlohmann::json without = status("orphaned");
  EXPECT_EQ(without["missing"], 0);
  EXPECT_NE(without["queue_trouble"], "");

  // Started again, it may believe any of its tasks to wait still; they would find nothing to do.
  slurm({cluster + "/controller"});
  EXPECT_TRUE(comes_true([&] { return status("orphaned")["queue_trouble"] == ""; }));
  slurm({"scancel", std::to_string(jobs.array), std::to_string(jobs.collect)});
  EXPECT_TRUE(comes_true([&] { return ended(jobs); }));
  expect_as_local("orphaned");
}

}  // namespace
}  // namespace sandstroke
