// Runs that are stopped, and go on.
#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/run_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Without what depends on the clock, and the file's name.
Json results(const ProgramResult& run) {
  Json summary = Json::parse(run.out, nullptr, false);
  for (const char* key :
       {"output", "wall_seconds", "real_time_factor", "process_seconds", "process_real_time_factor"})
    summary.erase(key);
  return summary;
}

class CliResume : public testing::Test {
 protected:
  CliResume() {  // some seconds of work
    write_file(folder / "scene.toml",
               "[bed]\nsize = [0.3, 0.2]\ncells = [600, 400]\n[tool]\nradius = 0.02\n[stroke]\nfile = "
               "\"line.toml\"\n[output]\nframes = 20\n");
    write_file(folder / "line.toml",
               "start = [-0.05, 0.0]\nspeed = 0.05\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\ndepth = "
               "0.004\n");
  }
  /// run: the words behind "run scene.toml".
  ProgramResult run(std::vector<std::string> words, const Conditions& conditions = {}) const {
    words.insert(words.begin(), {"run", "scene.toml", "--json"});
    return run_program(words, folder, conditions);
  }
  /// Stops a run into a.h5 once it has kept a state. On a busy machine it may end first: then once more.
  void stop(int signal) const {
    Conditions when_kept{signal};
    when_kept.when = [this] { return fs::exists(folder / "a.h5.state"); };
    for (int i = 0; i < 50; ++i) {
      fs::remove(folder / "a.h5");
      if (run({"-o", "a.h5", "--checkpoint", "0.02"}, when_kept).exit_code == 128 + signal) break;
    }
    ASSERT_TRUE(fs::exists(folder / "a.h5.state"));
  }

  const fs::path folder = test_folder();
};

TEST_F(CliResume, KilledOrStoppedItGoesOnToTheSameResult) {
  const ProgramResult whole = run({"-o", "whole.h5"});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  for (const int signal : {SIGKILL, SIGTERM, SIGINT}) {
    stop(signal);
    EXPECT_FALSE(fs::exists(folder / "a.h5"));
    const ProgramResult on = run({"-o", "a.h5", "--resume"});
    EXPECT_EQ(on.exit_code, 0) << on.err;
    EXPECT_EQ(results(on), results(whole));
    for (const char* left : {"a.h5.state", "a.h5.part"}) EXPECT_FALSE(fs::exists(folder / left)) << left;
    const ProgramResult same = run_program({"compare", "whole.h5", "a.h5", "--height-tolerance", "0",
                                            "--force-tolerance", "0", "--depth-tolerance", "0"},
                                           folder);
    EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
    EXPECT_EQ(RunFile(folder / "a.h5").frame_times(), RunFile(folder / "whole.h5").frame_times());
    fs::remove(folder / "a.h5");
  }
}

TEST_F(CliResume, WithoutAStateItBeginsAndWhenCompleteItSaysSo) {
  const ProgramResult begun = run({"-o", "a.h5", "--checkpoint", "60", "--resume"});
  EXPECT_EQ(begun.exit_code, 0) << begun.err;
  EXPECT_NE(begun.err.find("no state was kept; the run begins at its start"), std::string::npos) << begun.err;
  const std::string bytes = read_file(folder / "a.h5");
  const ProgramResult again = run({"-o", "a.h5", "--checkpoint", "60", "--resume"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(Json::parse(again.out)["already_complete"], true);
  EXPECT_EQ(read_file(folder / "a.h5"), bytes);
  // A kill came between the run's end and the removal of its state; the picture is still to be drawn.
  write_file(folder / "a.h5.state", "sandstroke run state 1\n");
  const ProgramResult pictured = run({"-o", "a.h5", "--resume", "--png", "a.png"});
  EXPECT_EQ(pictured.exit_code, 0) << pictured.err;
  EXPECT_FALSE(fs::exists(folder / "a.h5.state"));
  EXPECT_TRUE(fs::exists(folder / "a.png"));
  // Another stroke under the same name.
  write_file(folder / "line.toml",
             "start = [-0.05, 0.0]\nspeed = 0.05\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.01]\ndepth = "
             "0.004\n");
  EXPECT_FALSE(Json::parse(run({"-o", "a.h5", "--resume"}).out).contains("already_complete"));
}

TEST_F(CliResume, AnEstimateThatWasStoppedIsMadeByTheNextCommand) {
  const std::vector<std::string> words = {"-o",           "a.h5", "--estimate-error",
                                          "--checkpoint", "0.02", "--resume"};
  Conditions while_estimating{SIGINT};  // the final surface has been written by then
  while_estimating.when = [this, size = std::uintmax_t{0}, unchanged = 0]() mutable {
    const fs::path part = folder / "a.h5.part";
    std::error_code none;
    const std::uintmax_t now = fs::exists(part) ? fs::file_size(part, none) : 0;
    unchanged = std::exchange(size, now) == now && now > 0 ? unchanged + 1 : 0;
    return unchanged > 250;  // half a second, in which a run flushes
  };
  const ProgramResult stopped = run(words, while_estimating);
  if (stopped.exit_code == 0) GTEST_SKIP() << "the estimate took less than half a second";
  EXPECT_EQ(stopped.exit_code, 128 + SIGINT) << stopped.err;
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
  const ProgramResult on = run(words);
  EXPECT_EQ(on.exit_code, 0) << on.err;
  EXPECT_TRUE(Json::parse(on.out)["error_estimate"].is_object()) << on.out;
  EXPECT_TRUE(RunFile(folder / "a.h5").error_estimate().has_value());
}

TEST_F(CliResume, AStateIsNeitherLostNorTakenForAnotherRuns) {
  stop(SIGKILL);
  const std::string state = read_file(folder / "a.h5.state");
  const auto refused = [&](const std::vector<std::string>& words, const std::string& why) {
    const ProgramResult result = run(words);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
    EXPECT_EQ(read_file(folder / "a.h5.state"), state);
  };
  refused({"-o", "a.h5"}, "a.h5.state: keeps the state of a run that was stopped; go on with --resume");
  refused({"-o", "a.h5", "--resume", "--set", "relaxation.talus_angle=31"},
          "it has talus_angle = 30.0, this scene talus_angle = 31.0");
  refused({"-o", "a.h5", "--resume", "--estimate-error"}, "was kept without --estimate-error");
  write_file(
      folder / "line.toml",
      "start = [0.01, 0]\nspeed = 0.05\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\ndepth = 0.004\n");
  refused({"-o", "a.h5", "--resume"}, "another stroke");
  EXPECT_EQ(run({"-o", "a.h5", "--overwrite"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "a.h5.state"));
}

TEST_F(CliResume, ARunThatWasCutOffIsAStartAndItIsSaidWhich) {
  stop(SIGKILL);
  const std::vector<double> times = RunFile(folder / "a.h5.part").frame_times();
  write_file(folder / "scene.toml",
             "[bed]\nsize = [0.3, 0.2]\ncells = [600, 400]\nsurface.kind = \"file\"\nsurface.file = "
             "\"a.h5.part\"\n");
  const ProgramResult result = run({"-o", "b.h5"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find(fmt::format(
                "a.h5.part: the run was cut off; the bed begins with its surface at {:.4g} s", times.back())),
            std::string::npos)
      << result.err;
  const RunFile part(folder / "a.h5.part");
  EXPECT_TRUE((RunFile(folder / "b.h5").initial() == last_surface(part).surface.grid()).all());
}

TEST_F(CliResume, ARunThatOnlyRelaxesSaysThatItKeepsNoState) {
  write_file(folder / "scene.toml", "[bed]\nsize = [0.3, 0.2]\ncells = [60, 40]\n");
  const ProgramResult result = run({"-o", "a.h5", "--checkpoint", "1"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("has no stroke, so the run keeps no state"), std::string::npos) << result.err;
}

TEST_F(CliResume, ASweepsPointGoesOnWhereItWasKilled) {
  write_file(
      folder / "plan.toml",
      "[sweep]\nscene = \"scene.toml\"\nkeep = [\"surface\"]\nmetrics = [\"work\", \"max_force\"]\n[axes]\n"
      "force.k_s = [500, 1000]\n");
  const auto sweep = [&](const std::vector<std::string>& words, const Conditions& conditions = {}) {
    std::vector<std::string> all = {"sweep", "plan.toml", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    return run_program(all, folder, conditions);
  };
  const Json whole = Json::parse(sweep({"-o", "whole"}).out);
  const fs::path state = folder / "out/points/000000.state";
  Conditions when_kept{SIGKILL};
  when_kept.when = [&] { return fs::exists(state); };
  for (int i = 0; i < 50 && !fs::exists(state); ++i) {  // on a busy machine it may end first
    fs::remove_all(folder / "out");
    sweep({"-o", "out", "--checkpoint", "0.02"}, when_kept);
  }
  ASSERT_TRUE(fs::exists(state));
  EXPECT_FALSE(fs::exists(folder / "out/points/000000.h5"));
  const Json on = Json::parse(sweep({"-o", "out"}).out);
  EXPECT_EQ(on["content_hash"], whole["content_hash"]);
  EXPECT_FALSE(fs::exists(state));
}

}  // namespace
}  // namespace sandstroke
