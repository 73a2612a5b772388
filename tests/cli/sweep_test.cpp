#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/png_file.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class CliSweep : public testing::Test {
 protected:
  CliSweep() {
    plan("relaxation.talus_angle = [25, 30, 35]\nforce.k_s = { from = 500, to = 1500, count = 3 }\n");
  }
  void plan(const std::string& axes, const std::string& keys = "") {
    write_file(folder / "plan.toml", "[sweep]\nscene = \"scene.toml\"\n" + keys + "[axes]\n" + axes);
  }
  ProgramResult sweep(std::vector<std::string> arguments, const Conditions& conditions = {}) {
    arguments.insert(arguments.begin(), "sweep");
    return run_program(arguments, folder, conditions);
  }
  Json json(std::vector<std::string> arguments) {
    arguments.push_back("--json");
    const ProgramResult result = sweep(std::move(arguments));
    EXPECT_EQ(result.err, "");
    return Json::parse(result.out);
  }
  std::string content(const std::string& output) { return json({"collect", output}).at("content_hash"); }

  const fs::path folder = test_folder();
};

TEST_F(CliSweep, RunsCollectsAndSaysWhatItSaved) {
  const ProgramResult result = sweep({"plan.toml", "-o", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("9: 9 run now"), std::string::npos) << result.out;
  for (const char* name : {"sweep.h5", "sweep.csv", "sweep.html"})
    EXPECT_TRUE(fs::exists(folder / "out" / name));
  const std::string csv = read_file(folder / "out/sweep.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 10);

  const Json again = json({"plan.toml", "-o", "out"});
  EXPECT_EQ(again["done_before"], 9);
  EXPECT_EQ(again["simulations"], 0);
  const Json fresh = json({"plan.toml", "-o", "fresh"});
  EXPECT_EQ(fresh["simulations"], 3);  // of nine points
  EXPECT_EQ(fresh["strokes_loaded"], 1);
  EXPECT_EQ(fresh["content_hash"], again["content_hash"]);
}

TEST_F(CliSweep, PicturesOfPointsAreThoseOfTheirRuns) {
  for (const std::string view : {"overview", "stroke"}) {
    write_file(folder / "sweep.toml",
               "[sweep]\nscene = \"scene.toml\"\nkeep = [\"picture\"]\n[set]\nview.name = \"" + view +
                   "\"\n[axes]\nrelaxation.talus_angle = [15.0, 35.0]\n");
    const ProgramResult sweep = run_program({"sweep", "sweep.toml", "-o", view}, folder);
    ASSERT_EQ(sweep.exit_code, 0) << sweep.err;
    const ProgramResult run = run_program({"run", "scene.toml", "-o", "a.h5", "--png", "a.png", "--set",
                                           "relaxation.talus_angle=35", "--set", "view.name=" + view},
                                          folder);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(read_png(folder / view / "points/000001.png").rgb == read_png(folder / "a.png").rgb) << view;
  }
}

TEST_F(CliSweep, LeavesNothingWithoutACluster) {
  Conditions conditions;
  conditions.path = folder.string();  // where no sbatch is
  const ProgramResult result = sweep({"plan.toml", "-o", "out", "--slurm"}, conditions);
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("sbatch is not installed"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(CliSweep, KeepsToTheNumberOfTasksThatAClusterTakes) {
  plan("relaxation.talus_angle = { from = 20, to = 45, count = 60 }\n");
  const fs::path bin = folder / "bin";
  fs::create_directory(bin);
  const auto program = [&](const std::string& name, const std::string& text) {
    write_file(bin / name, "#!/bin/sh\n" + text + "\n");
    fs::permissions(bin / name, fs::perms::owner_all);
  };
  program("squeue", "exit 0");
  program("scontrol", "exit 1");
  program("sacctmgr", "exit 1");
  // Refuses arrays of task 11 and above, as a cluster with MaxArraySize = 11 does.
  program("sbatch",
          "for file; do :; done; [ \"$1\" = --version ] && exit 0\n"
          "last=$(sed -n 's/^#SBATCH --array=.*[-,]//p' \"$file\")\n"
          "[ \"${last:-1}\" -gt 10 ] && { echo 'sbatch: error: one' >&2; echo 'sbatch: error: Batch job "
          "submission failed: Invalid job array specification' >&2; exit 1; }\n"
          "echo 4242");
  Conditions conditions;
  conditions.path = bin.string() + ":/usr/bin:/bin";
  const ProgramResult halved = sweep({"plan.toml", "-o", "halved", "--slurm"}, conditions);
  EXPECT_EQ(halved.exit_code, 0) << halved.err;
  EXPECT_NE(
      halved.err.find("sbatch: error: one; sbatch: error: Batch job submission failed: Invalid job array "
                      "specification: tries 7 tasks instead of 15"),
      std::string::npos)
      << halved.err;
  EXPECT_NE(halved.out.find("of 7 tasks"), std::string::npos) << halved.out;
  program("scontrol", "echo 'MaxArraySize            = 11'");
  const ProgramResult asked =
      sweep({"plan.toml", "-o", "asked", "--slurm", "--tasks", "40", "--json"}, conditions);
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_NE(asked.err.find("10 tasks instead of 40, because the cluster takes no more (MaxArraySize = 11)\n"),
            std::string::npos)
      << asked.err;
  EXPECT_EQ(Json::parse(asked.out)["tasks"], 10);
  // What status advises works.
  const std::string advice = json({"status", "asked"})["advice"];
  EXPECT_NE(advice.find("run sandstroke sweep " + (folder / "plan.toml").string() + " -o asked"),
            std::string::npos)
      << advice;
}

TEST_F(CliSweep, ThePointsOfSeveralKindsRunAlone) {
  plan("tool.shape = [\"sphere\", \"plate\"]\ntool.width = [0.02, 0.03]\n",
       "metrics = [\"work\"]\n[set]\ndisplacement.deposit = \"outward\"\nbed.cells = [300, 200]\n");
  const ProgramResult result = sweep({"plan.toml", "-o", "out", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("tool.shape = sphere: tool.width is left out"), std::string::npos) << result.err;
  EXPECT_EQ(Json::parse(result.out)["simulations"], 3) << "two points differ only in what is left out";
  const std::string page = read_file(folder / "out/sweep.html");
  const auto begin = page.find("type=\"application/json\" id=\"data\">") + 34;
  const Json data = Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_EQ(std::string(data["points"][0]["command"]).find("tool.width"), std::string::npos);
  EXPECT_NE(std::string(data["points"][3]["command"]).find("tool.width=0.03"), std::string::npos);
}

TEST_F(CliSweep, StrokesInMillimetresArePointedOut) {
  plan("stroke.depth = [0.001, 4, 5]\n");
  for (const std::vector<std::string>& how : {{"--dry-run"}, std::vector<std::string>{"-o", "out"}}) {
    std::vector<std::string> words = {"plan.toml"};
    words.insert(words.end(), how.begin(), how.end());
    const std::string said = sweep(words).err;
    EXPECT_NE(said.find("the first is point 1: line.toml: goes 4.004 m deep"), std::string::npos) << said;
  }
}

TEST_F(CliSweep, APointsCommandGivesThePointsFigures) {
  plan("relaxation.talus_angle = [25, 35]\nmodel.preset = [\"paper\", \"accurate\"]\n",
       "metrics = [\"work\", \"max_force\"]\n");
  ASSERT_EQ(sweep({"plan.toml", "-o", "out"}).exit_code, 0);
  const std::string page = read_file(folder / "out/sweep.html");
  const auto begin = page.find("type=\"application/json\" id=\"data\">") + 34;
  const Json data = Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  const std::string command = data["points"][3]["command"];
  const std::string start = "sandstroke run ";
  ASSERT_TRUE(command.starts_with(start));
  // The command as a shell takes it.
  const std::string line = "cd '" + folder.string() + "' && " + SANDSTROKE_PROGRAM + " run " +
                           command.substr(start.size()) + " --json > run.json";
  ASSERT_EQ(std::system(line.c_str()), 0) << line;
  const Json run = Json::parse(read_file(folder / "run.json"));
  EXPECT_EQ(run["absorbed_energy"], data["points"][3]["metrics"][0]);
  EXPECT_EQ(run["max_force"], data["points"][3]["metrics"][1]);
}

TEST_F(CliSweep, InterruptedAndKilledItGoesOnToTheSameEnd) {
  // Each is a simulation of its own.
  plan("device.model = [\"dynamic\"]\nforce.k_s = { from = 500, to = 900, count = 60 }\n");
  ASSERT_EQ(sweep({"plan.toml", "-o", "whole"}).exit_code, 0);
  const auto signal_after = [&](int signal, int points) {
    Conditions conditions{signal};
    conditions.when = [points, place = folder / "out/points"] {
      const auto is_point = [](const fs::directory_entry& file) { return file.path().extension() == ".h5"; };
      return fs::exists(place) && std::count_if(fs::directory_iterator(place), {}, is_point) >= points;
    };
    return conditions;
  };
  const ProgramResult interrupted = sweep({"plan.toml", "-o", "out", "--jobs", "1"}, signal_after(SIGINT, 5));
  EXPECT_EQ(interrupted.exit_code, 130);
  EXPECT_NE(interrupted.err.find("the same command continues"), std::string::npos) << interrupted.err;
  EXPECT_FALSE(fs::exists(folder / "out/sweep.h5"));
  EXPECT_EQ(sweep({"plan.toml", "-o", "out", "--jobs", "1"}, signal_after(SIGKILL, 20)).exit_code,
            128 + SIGKILL);
  const Json status = json({"status", "out"});
  EXPECT_GE(status["done"], 20);
  EXPECT_GT(status["missing"], 0);
  const Json resumed = json({"plan.toml", "-o", "out"});
  EXPECT_EQ(resumed["done_before"], status["done"]);
  EXPECT_EQ(resumed["run"], status["missing"]);
  EXPECT_EQ(resumed["content_hash"], content("whole"));
}

TEST_F(CliSweep, StopsBetweenPointsThatShareASimulationWhenInterrupted) {
  const int points = sanitized ? 400 : 4000;
  plan(fmt::format("force.k_s = {{ from = 100, to = 2000, count = {} }}\n", points),
       "metrics = [\"max_force\"]\n");
  Conditions interrupt;
  interrupt.signal = SIGINT;
  interrupt.when = [this] { return fs::exists(folder / "out/points/000000.h5"); };
  const ProgramResult stopped = sweep({"plan.toml", "-o", "out"}, interrupt);
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_NE(stopped.err.find(fmt::format("of {} points done", points)), std::string::npos) << stopped.err;
  EXPECT_FALSE(fs::exists(folder / fmt::format("out/points/{:06}.h5", points - 1)));
}

TEST_F(CliSweep, ShardsMakeOneWhole) {
  ASSERT_EQ(sweep({"plan.toml", "-o", "whole"}).exit_code, 0);
  EXPECT_EQ(sweep({"plan.toml", "-o", "out", "--shard", "2/2"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "out/sweep.h5"));
  EXPECT_NE(json({"status", "out"})["missing"], 0);
  EXPECT_EQ(sweep({"plan.toml", "-o", "out", "--shard", "1/2"}).exit_code, 0);
  EXPECT_EQ(content("out"), content("whole"));
}

TEST_F(CliSweep, ADryRunCountsAndLeavesNothing) {
  const ProgramResult result = sweep({"plan.toml", "-o", "out", "--dry-run"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("9 points need 3 simulations"), std::string::npos) << result.out;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(CliSweep, ADryRunForSlurmShowsTheJobScriptAndAsksNobody) {
  const ProgramResult result =
      sweep({"plan.toml", "-o", "out", "--dry-run", "--slurm", "--tasks", "2", "--mem", "3G"});
  EXPECT_EQ(result.exit_code, 0) << result.err;  // with or without a cluster
  for (const char* line : {"#!/bin/sh\n", "#SBATCH --array=1-2\n", "#SBATCH --mem=3G\n"})
    EXPECT_NE(result.out.find(line), std::string::npos) << result.out;
  EXPECT_FALSE(fs::exists(folder / "out"));
  const Json shown = json({"plan.toml", "--dry-run", "--slurm"});
  EXPECT_NE(shown["job_script"].get<std::string>().find("--shard"), std::string::npos);
}

/// It cannot look at all ten million points, and says the same as if it had.
TEST_F(CliSweep, ADryRunOfTenMillionPointsCountsThemByTheirAxes) {
  plan(
      "relaxation.talus_angle = { from = 20, to = 40, count = 1000 }\n"
      "force.k_s = { from = 500, to = 1500, count = 10000 }\n",
      "max_points = 10000000\n");
  const ProgramResult result = sweep({"plan.toml", "--dry-run"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("10000000 points need about 1000 simulations"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\n...\n"), std::string::npos) << result.out;
  const Json counted = json({"plan.toml", "--dry-run"});
  EXPECT_EQ(counted["points"], 10000000);
  EXPECT_EQ(counted["simulations"], 1000);
  EXPECT_EQ(counted["looked_at"], 1000);
  // The ends of a range are checked.
  plan("relaxation.talus_angle = { from = 20, to = 100, count = 1000 }\n");
  const ProgramResult wrong = sweep({"plan.toml", "--dry-run"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("axes.relaxation.talus_angle cannot be"), std::string::npos) << wrong.err;
}

TEST_F(CliSweep, FailingPointsAreExitCodeThreeAndStatusSaysWhy) {
  plan("device.scale = [1, 30]\n");
  const ProgramResult result = sweep({"plan.toml", "-o", "out"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("1 point"), std::string::npos) << result.err;
  const ProgramResult status = sweep({"status", "out"});
  EXPECT_NE(status.out.find("outside the bed"), std::string::npos) << status.out;
}

TEST_F(CliSweep, RefusesInASentenceAndTouchesNothing) {
  ASSERT_EQ(sweep({"plan.toml", "-o", "out"}).exit_code, 0);
  const auto before = fs::last_write_time(folder / "out/sweep.h5");
  fs::create_directories(folder / "mine");
  write_file(folder / "mine/thesis.txt", "precious");
  write_file(folder / "other.toml", "[sweep]\nscene = \"scene.toml\"\n[axes]\nforce.k_s = [1]\n");
  const std::vector<std::tuple<std::vector<std::string>, int, std::string>> cases = {
      {{}, 2, "name a plan"},
      {{"none.toml"}, 4, "none.toml: cannot be opened"},
      {{"scene.toml"}, 2, "scene.toml: is a scene, not a sweep plan"},
      {{"plan.toml", "--shard", "3/2"}, 2, "--shard 3/2 is not a part of a sweep; write I/N"},
      {{"plan.toml", "--shard", "0/2"}, 2, "--shard 0/2"},
      {{"plan.toml", "--shard", "1"}, 2, "--shard 1"},
      {{"plan.toml", "--shard", "1/2x"}, 2, "--shard 1/2x"},
      {{"plan.toml", "--jobs", "-1"}, 2, "--jobs"},
      {{"other.toml", "-o", "out"}, 2, "out: holds another sweep, whose axes differ"},
      {{"plan.toml", "-o", "mine"}, 2, "mine: holds other files"},
      {{"plan.toml", "-o", "scene.toml"}, 4, "scene.toml"},
      {{"status", "mine"}, 4, "mine: is not a sweep folder"},
      {{"collect", "none"}, 4, "none: is not a sweep folder"},
  };
  for (const auto& [arguments, exit_code, sentence] : cases) {
    const ProgramResult result = sweep(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << sentence;
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
  }
  EXPECT_EQ(fs::last_write_time(folder / "out/sweep.h5"), before);
  EXPECT_EQ(read_file(folder / "mine/thesis.txt"), "precious");
  EXPECT_FALSE(fs::exists(folder / "plan"));
}

TEST_F(CliSweep, AFullDiskEndsItAndLeavesNoPointThatLooksComplete) {
  if (threads_sanitized) GTEST_SKIP() << "the sanitizer's own memory is a file";
  plan("force.k_s = [500, 1000]\n", "keep = [\"surface\"]\n");
  const ProgramResult result = sweep({"plan.toml", "-o", "out"}, {.most_file_bytes = 20'000});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("cannot be written"), std::string::npos) << result.err;
  for (const auto& file : fs::directory_iterator(folder / "out/points"))
    EXPECT_NE(file.path().extension(), ".h5");
  EXPECT_EQ(sweep({"plan.toml", "-o", "out"}).exit_code, 0);
}

TEST_F(CliSweep, ANameThatTheSystemRefusesIsSaidInASentence) {
  const std::string name(300, 'a');
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"status", name}, {"collect", name}, {"plan.toml", "-o", name}}) {
    const ProgramResult result = sweep(arguments);
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_EQ(result.err.find("unexpected"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("File name too long"), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace sandstroke
