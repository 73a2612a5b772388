#include "sweep/slurm_jobs.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <limits>

#include "core/error.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// Programs that stand for Slurm's, found before any others while this is there. sbatch gives the ids 41, 42,
/// ... and notes its words; squeue prints a file.
class PretendedSlurm {
 public:
  PretendedSlurm() : path_(getenv("PATH")) {
    program("sbatch", "n=$(($(cat n) + 1)); echo $n | tee n; printf '%s|' \"$@\" >> calls; echo >> calls");
    program("squeue", "cat queue");
    put_text(folder_ / "n", "40");
    queue("");
    setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
  }
  ~PretendedSlurm() { setenv("PATH", path_.c_str(), 1); }
  void program(const std::string& name, const std::string& text) const {
    put_text(folder_ / name, "#!/bin/sh\ncd '" + folder_.path().string() + "'\n" + text + "\n");
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  void queue(const std::string& text) const { put_text(folder_ / "queue", text); }
  std::string calls() const {
    return fs::exists(folder_ / "calls") ? read_text_file(folder_ / "calls") : std::string();
  }

 private:
  TestFolder folder_;
  std::string path_;
};

std::string sentence_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SlurmQueue, IsReadLineByLine) {
  const auto tasks = parse_queue(
      "12|3|PENDING|1|BeginTime|\n"
      "12|4|RUNNING|0|None|\n"
      "13|N/A|PENDING|0|Dependency|\n"
      "some warning\n"
      "14|\n");
  ASSERT_EQ(tasks.size(), 3u);
  EXPECT_EQ(tasks[0].job, 12);
  EXPECT_EQ(tasks[0].task, 3);
  EXPECT_EQ(tasks[0].state, "PENDING");
  EXPECT_EQ(tasks[0].restarts, 1);
  EXPECT_EQ(tasks[0].reason, "BeginTime");
  EXPECT_EQ(tasks[1].reason, "");
  EXPECT_EQ(tasks[2].task, 0);
}

TEST(SlurmQueue, JobsThatHaveEndedAreNotAlive) {
  const auto alive = [](const char* state) { return QueuedTask{1, 1, state, 0, ""}.alive(); };
  for (const char* state :
       {"PENDING", "RUNNING", "COMPLETING", "SUSPENDED", "CONFIGURING", "REQUEUE_HOLD", "SOMETHING_NEW"})
    EXPECT_TRUE(alive(state)) << state;
  for (const char* state : {"COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "OUT_OF_MEMORY", "NODE_FAIL"})
    EXPECT_FALSE(alive(state)) << state;
}

class SlurmJobsTest : public testing::Test {
 protected:
  SlurmJobs submit() const {
    return submit_to_slurm({}, {"/opt/sandstroke", folder_.path(), "plan.toml", "out"},
                           {{1, {0, 3}}, {3, {2}}}, 3);
  }
  TestFolder folder_;
  PretendedSlurm slurm_;
};

TEST_F(SlurmJobsTest, AreRemembered) {
  EXPECT_FALSE(read_slurm_jobs(folder_ / "out"));
  const SlurmJobs jobs = submit();
  EXPECT_EQ(jobs.array, 41);
  EXPECT_EQ(jobs.collect, 42);
  const auto read = read_slurm_jobs(folder_ / "out");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->array, 41);
  EXPECT_EQ(read->collect, 42);
  EXPECT_EQ(read->of, 3);
  ASSERT_EQ(read->tasks.size(), 2u);
  EXPECT_EQ(read->tasks[0].points, (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(read->tasks[1].number, 3);
}

TEST_F(SlurmJobsTest, CollectingWaitsForTheEndOfTheArray) {
  submit();
  const std::string folder = (folder_ / "out/slurm").string();
  EXPECT_EQ(slurm_.calls(), "--parsable|" + folder + "/job.sh|\n--parsable|--dependency=afterany:41|" +
                                folder + "/collect.sh|\n");
}

TEST_F(SlurmJobsTest, AreNotSubmittedTwiceWhileTheyAreQueued) {
  submit();
  slurm_.queue("41|1|COMPLETED|0|None|\n41|3|RUNNING|0|None|\n42|N/A|PENDING|0|Dependency|\n");
  EXPECT_EQ(sentence_of([&] { submit(); }), (folder_ / "out").string() +
                                                ": was already submitted, and 2 of its jobs are still "
                                                "queued; wait for them, or cancel them: scancel 41 42");
  slurm_.queue("41|1|COMPLETED|0|None|\n41|3|TIMEOUT|0|None|\n");
  EXPECT_EQ(submit().array, 43);
}

TEST_F(SlurmJobsTest, AreNotSubmittedTwiceWhereTheQueueIsNotKnown) {
  submit();
  slurm_.program("squeue", "echo 'Unable to contact slurm controller' >&2; exit 1");
  EXPECT_NE(sentence_of([&] { submit(); }).find("Unable to contact slurm controller"), std::string::npos);
}

TEST_F(SlurmJobsTest, SlurmsOwnSentenceSaysWhyItRefuses) {
  slurm_.program("sbatch", "echo 'sbatch: error: invalid partition specified: sand' >&2; exit 1");
  EXPECT_NE(sentence_of([&] { submit(); }).find("invalid partition specified: sand"), std::string::npos);
  EXPECT_FALSE(read_slurm_jobs(folder_ / "out"));
}

TEST_F(SlurmJobsTest, SeveralLinesOfSlurmsAreOneSentence) {
  slurm_.program("sbatch",
                 "printf 'sbatch: error: AssocMaxSubmitJobLimit\nsbatch: error: Batch job submission "
                 "failed: Job violates accounting/QOS policy (job submit limit)\n' >&2; exit 1");
  const std::string sentence = sentence_of([&] { submit(); });
  EXPECT_NE(
      sentence.find("sbatch: error: AssocMaxSubmitJobLimit; sbatch: error: Batch job submission failed: Job "
                    "violates accounting/QOS policy (job submit limit)"),
      std::string::npos)
      << sentence;
  EXPECT_EQ(sentence.find('\n'), std::string::npos);
  EXPECT_THROW(submit(), TooManyTasks);
  slurm_.program("sbatch",
                 "echo 'sbatch: error: Batch job submission failed: Invalid job array specification' "
                 ">&2; exit 1");
  EXPECT_THROW(submit(), TooManyTasks);
}

TEST_F(SlurmJobsTest, TheClustersLimitsAreAskedFor) {
  EXPECT_EQ(ask_slurm_limits().most_tasks(), std::numeric_limits<int>::max());
  slurm_.program("scontrol", "echo 'MaxArrayTasks = 7'; echo 'MaxArraySize            = 101'");
  EXPECT_EQ(ask_slurm_limits().most_tasks(), 100);
  EXPECT_EQ(ask_slurm_limits().text(), "MaxArraySize = 101");
  slurm_.program("sacctmgr", "echo; echo 200; echo 50");
  slurm_.queue("7_1\n7_2\n");
  EXPECT_EQ(ask_slurm_limits().most_tasks(), 47) << "two are queued, and one collects";
  slurm_.program("sacctmgr", "echo 1");
  EXPECT_EQ(ask_slurm_limits().most_tasks(), 1);
  slurm_.program("scontrol",
                 "echo 'slurm_load_ctl_conf error: Unable to contact slurm controller' >&2; exit 1");
  slurm_.program("sacctmgr", "exit 1");
  EXPECT_FALSE(ask_slurm_limits().array_size || ask_slurm_limits().submit_jobs);
}

TEST_F(SlurmJobsTest, AreQueuedEvenIfNothingWillCollectThem) {
  slurm_.program("sbatch", "case $* in *collect.sh) exit 1;; esac; echo 41");
  EXPECT_EQ(submit().collect, 0);
  EXPECT_EQ(read_slurm_jobs(folder_ / "out")->array, 41);
}

TEST_F(SlurmJobsTest, SaysThatThereIsNoSlurm) {
  const std::string path = getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  EXPECT_NE(sentence_of([&] { submit(); }).find("sbatch is not installed"), std::string::npos);
  EXPECT_EQ(ask_slurm_queue({}).trouble, "squeue is not installed");
  setenv("PATH", path.c_str(), 1);
}

TEST_F(SlurmJobsTest, TheNoteOfALargeSweepMayBeLargerThanTextsThatPeopleWrite) {
  make_folder(folder_ / "out/slurm");
  put_text(folder_ / "out/slurm/jobs.json",
           std::string(most_text_bytes, ' ') + R"({"array": 7, "collect": 0, "of": 1, "tasks": []})");
  EXPECT_EQ(read_slurm_jobs(folder_ / "out")->array, 7);
}

TEST_F(SlurmJobsTest, ADamagedNoteSaysSo) {
  make_folder(folder_ / "out/slurm");
  for (
      const char* note :
      {"{\"array\": ", R"({"array": 1e300, "collect": 0, "of": 1, "tasks": []})",
       R"({"array": 1, "collect": -1, "of": 1, "tasks": []})",
       R"({"array": 1, "collect": 0, "of": 4294967297, "tasks": []})",
       R"({"array": 1, "collect": 0, "of": 1, "tasks": [{"number": 1, "points": [18446744073709551615]}]})"}) {
    put_text(folder_ / "out/slurm/jobs.json", note);
    EXPECT_NE(sentence_of([&] { submit(); }).find("jobs.json: is damaged"), std::string::npos) << note;
  }
}

}  // namespace
}  // namespace sandstroke
