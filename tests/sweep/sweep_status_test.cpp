#include "sweep/sweep_status.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "test_folder.h"

namespace sandstroke {
namespace {

/// A sweep of eight points.
class SweepStatusTest : public testing::Test {
 protected:
  static SweepManifest manifest() {
    SweepManifest m;
    m.scene = "scene.toml";
    m.design = {true, {{"force.k_s", "N/m", false, {"1", "2", "3", "4", "5", "6", "7", "8"}}}};
    m.metrics = {"max_force"};
    return m;
  }
  void done(std::initializer_list<std::size_t> points, PointVerdict verdict = PointVerdict::at_rest) const {
    for (const std::size_t point : points)
      folder.write(point, {verdict, failed(verdict) ? "why" : "", {1.0}}, "", {});
  }
  SweepStatus local() const { return sweep_status(folder, std::nullopt, {}); }
  /// Three tasks that were to do all but point 0, and what the queue says of them.
  SweepStatus queued(const std::string& queue) const {
    return sweep_status(folder, SlurmJobs{12, 13, 3, {{1, {3, 6}}, {2, {1, 4, 7}}, {3, {2, 5}}}},
                        {parse_queue(queue), ""});
  }

  TestFolder test_folder;
  const SweepFolder folder = SweepFolder::make(test_folder / "sweep", manifest());
};

TEST_F(SweepStatusTest, AdvisesTheWholeCommandWhereTheFolderKnowsItsPlan) {
  SweepManifest m = manifest();
  m.plan = "/here/my plan.toml";
  const SweepFolder planned = SweepFolder::make(test_folder / "planned", m);
  const std::string command = "run sandstroke sweep '/here/my plan.toml' -o " + planned.path().string();
  EXPECT_EQ(sweep_status(planned, std::nullopt, {}).advice(), "8 points are missing: " + command);
  EXPECT_EQ(
      sweep_status(planned, SlurmJobs{12, 13, 1, {{1, {0, 1}}}}, {std::vector<QueuedTask>{}, ""}).advice(),
      "1 task is gone and left 2 points: " + command + " --slurm");
  EXPECT_EQ(SweepFolder::open(planned.path()).manifest().plan, m.plan);
  m.plan = "/moved/plan.toml";
  EXPECT_NO_THROW(SweepFolder::make(planned.path(), m)) << "a moved plan is the same sweep";
}

TEST_F(SweepStatusTest, CountsWhatTheFolderHolds) {
  done({0, 3});
  done({1}, PointVerdict::not_at_rest);
  done({5}, PointVerdict::unstable);
  done({6}, PointVerdict::refused);
  std::ofstream(folder.point_file(7)) << "cut off";
  const SweepStatus status = local();
  EXPECT_EQ(status.points, 8u);
  EXPECT_EQ(status.missing, 3u);
  EXPECT_EQ(status.verdicts, (std::array<std::size_t, 5>{2, 1, 0, 1, 1}));
  EXPECT_EQ(status.failures, (std::vector<std::pair<std::size_t, std::string>>{{5, "why"}, {6, "why"}}));
  EXPECT_EQ(status.advice(), "3 points are missing: run the same command again");
  const auto json = as_json(status);
  EXPECT_EQ(json["done"], 5);
  EXPECT_EQ(json["failed"], 2);
  EXPECT_EQ(json["verdicts"]["not at rest"], 1);
  EXPECT_TRUE(json["job_array"].is_null());
}

TEST_F(SweepStatusTest, SaysWhenAllIsDone) {
  done({0, 1, 2, 3, 4, 5, 6});
  done({7}, PointVerdict::not_at_rest);
  EXPECT_EQ(local().advice(),
            "all points are done: collect them with sandstroke sweep collect " + folder.path().string());
  std::ofstream(folder.path() / "sweep.h5") << "collected";
  EXPECT_EQ(local().advice(), "all points are done: sweep.html shows them");
  const auto collected = std::filesystem::last_write_time(folder.path() / "sweep.h5");
  std::filesystem::last_write_time(folder.point_file(3), collected + std::chrono::seconds(1));
  EXPECT_EQ(local().advice(),
            "all points are done: collect them with sandstroke sweep collect " + folder.path().string());
}

TEST_F(SweepStatusTest, PointsThatFailedAreDone) {
  done({0, 1, 2, 3, 4, 5, 6});
  done({7}, PointVerdict::refused);
  EXPECT_EQ(local().advice(),
            "all points are done, but 1 failed: collect them with sandstroke sweep collect " +
                folder.path().string());
}

TEST_F(SweepStatusTest, TasksAreWhatFolderAndQueueSay) {
  done({0, 3, 6, 4});
  done({1}, PointVerdict::unstable);
  const SweepStatus status =
      queued("12|2|PENDING|1|BeginTime|\n12|1|COMPLETED|0|None|\n13|N/A|PENDING|0|Dependency|\n");
  ASSERT_EQ(status.tasks.size(), 3u);
  EXPECT_EQ(status.tasks[0].state, "done");
  EXPECT_EQ(status.tasks[1].state, "requeued");
  EXPECT_EQ(status.tasks[1].failed, 1u);
  EXPECT_EQ(status.tasks[1].missing, 1u);
  EXPECT_EQ(status.tasks[1].reason, "BeginTime");
  EXPECT_EQ(status.tasks[2].state, "gone");
  EXPECT_EQ(status.advice(),
            "1 task is queued or running; 1 task is gone and left 2 points: wait for the others, then run "
            "the same command again");
  EXPECT_EQ(open_tasks(status).rows(), 2u);
}

TEST_F(SweepStatusTest, TasksThatAreAtWorkAreWaitedFor) {
  done({0, 3});
  EXPECT_EQ(queued("12|1|RUNNING|0|None|\n12|2|RUNNING|1|None|\n12|3|PENDING|0|Resources|\n").advice(),
            "3 tasks are queued or running: wait");
}

TEST_F(SweepStatusTest, HeldTasksAreNotWaitedFor) {
  const SweepStatus status = queued(
      "12|1|RUNNING|0|None|\n12|2|PENDING|1|launch failed requeued held|\n12|3|PENDING|0|JobHeldUser|\n");
  EXPECT_EQ(status.tasks[1].state, "held");
  EXPECT_EQ(status.advice(),
            "2 tasks are held: scontrol release 12; or scancel 12, and run the same command again");
}

TEST_F(SweepStatusTest, WhatGoneTasksLeftIsCounted) {
  done({0, 3, 7});
  const SweepStatus status = queued("12|3|TIMEOUT|0|None|\n");
  EXPECT_EQ(status.tasks[2].state, "gone");
  EXPECT_EQ(status.tasks[2].reason, "timeout");
  EXPECT_EQ(status.advice(), "3 tasks are gone and left 5 points: run the same command again");
}

TEST_F(SweepStatusTest, OtherJobsOfTheQueueAreNotIts) {
  done({0, 3, 6, 1, 4, 7});
  EXPECT_EQ(queued("11|3|RUNNING|0|None|\n13|3|RUNNING|0|None|\n").tasks[2].state, "gone");
}

TEST_F(SweepStatusTest, KnowsOnlyTheFolderWithoutAQueue) {
  done({0, 1, 2, 3, 4, 5, 6});
  const SweepStatus status =
      sweep_status(folder, SlurmJobs{12, 13, 2, {{1, {0, 2, 4, 6}}, {2, {1, 3, 5, 7}}}},
                   {std::nullopt, "squeue is not installed"});
  EXPECT_EQ(status.tasks[0].state, "done");
  EXPECT_EQ(status.tasks[1].state, "unknown");
  EXPECT_EQ(status.advice(),
            "1 point is missing, and the queue cannot be asked: squeue is not installed; when "
            "nothing is queued, run the same command again");
}

TEST_F(SweepStatusTest, ThePointsOfALargerSweepThatWasHereDoNotHarm) {
  const SweepStatus status =
      sweep_status(folder, SlurmJobs{12, 13, 1, {{1, {7, 8, 1000}}}}, {std::vector<QueuedTask>(), ""});
  EXPECT_EQ(status.tasks[0].missing, 1u);
}

}  // namespace
}  // namespace sandstroke
