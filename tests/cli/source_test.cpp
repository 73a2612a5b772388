// Scenes that pour sand and take it.
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/run_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string bed = "[model]\npreset = \"accurate\"\n[bed]\nsize = [0.2, 0.2]\ncells = [50, 50]\n";
const std::string cone = "[[source]]\nat = [0.0, 0.0, 0.1]\nrate = 0.02\nstop = 0.5\n";
const std::string sink = "[[source]]\nat = [0.0, 0.0, 0.004]\nrate = -0.01\nradius = 0.006\nstop = 0.8\n";

fs::path folder_of_cone() {
  fs::path folder = test_folder();
  write_file(folder / "cone.toml", bed + cone + sink);
  return folder;
}

TEST(CliSource, SaysWhereItsSandIs) {
  const fs::path folder = folder_of_cone();
  const ProgramResult run = run_program({"run", "cone.toml", "--frames", "10"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("source             poured 0.01 kg, landed 0.01 kg, in the air 0 kg\n"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("sink               took "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("kg of 0.008 kg asked\n"), std::string::npos) << run.out;
  EXPECT_EQ(run.err.find("touch"), std::string::npos) << run.err;  // there is no tool

  const Json json = Json::parse(run_program({"run", "cone.toml", "--json"}, folder).out);
  ASSERT_EQ(json["sources"].size(), 2u);
  EXPECT_NEAR(json["sources"][0]["landed"].get<double>(), 0.01, 1e-16);
  EXPECT_EQ(json["sources"][0]["in_air"], 0.0);
  const double taken = json["sources"][1]["taken"], density = 1560.0;
  EXPECT_GT(taken, 1e-4);
  EXPECT_LT(taken, 0.0079);
  EXPECT_NEAR(json["given_volume"].get<double>(), (0.01 - taken) / density, 1e-18);
  EXPECT_NEAR(json["volume_final"].get<double>(), (0.01 - taken) / density, 1e-18);
  EXPECT_LT(json["volume_drift"].get<double>(), 1e-14);

  const Json info = Json::parse(run_program({"info", "cone.h5", "--json"}, folder).out);
  EXPECT_EQ(info["sources"], json["sources"]);
  EXPECT_EQ(RunFile(folder / "cone.h5").sources().size(), 2u);
  const ProgramResult table = run_program({"info", "cone.h5"}, folder);
  EXPECT_NE(table.out.find("sources/0/poured            0.01 kg\n"), std::string::npos) << table.out;
}

TEST(CliSource, FollowsAStrokeFile) {
  const fs::path folder = test_folder();
  write_file(folder / "path.toml",
             "start = [-0.05, 0.0]\nspeed = 0.1\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\ndepth = "
             "-0.02\n");
  write_file(folder / "scene.toml",
             bed + "[[source]]\npath = \"path.toml\"\nat = [0.0, 0.02, 0.0]\nrate = 0.01\n");
  const ProgramResult run = run_program({"run", "scene.toml", "--json"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_NEAR(json["sources"][0]["landed"].get<double>(), 0.01, 1e-4);  // for a second
  EXPECT_LT(json["volume_drift"].get<double>(), 1e-14);
  const HeightGrid sand = RunFile(folder / "scene.h5").final();
  EXPECT_GT(sand(29, 25), 1e-3);  // at y = 18 mm
  EXPECT_GT(sand(29, 15), 1e-3);
  EXPECT_EQ(sand(25, 25), 0.0);
  const ProgramResult missing =
      run_program({"run", "scene.toml", "--set", "source.1.path=none.toml"}, folder);
  EXPECT_EQ(missing.exit_code, 4);
  EXPECT_NE(missing.err.find("none.toml"), std::string::npos) << missing.err;
}

TEST(CliSource, IsRefusedByOneSentence) {
  const fs::path folder = folder_of_cone();
  const auto refused = [&](const std::vector<std::string>& words, const std::string& sentence) {
    const ProgramResult run = run_program(words, folder);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_NE(run.err.find(sentence), std::string::npos) << run.err;
  };
  const auto set = [](const std::string& setting) {
    return std::vector<std::string>{"run", "cone.toml", "--set", setting};
  };
  refused(set("source.1.rate=0"), "source.1.rate = 0: it neither pours nor takes sand");
  refused(set("source.2.start=1"), "source.2.stop = 0.8 s is not after its start = 1 s");
  refused(set("source.1.at=[0.2, 0, 0.1]"), "source.1.at is 100 mm beyond the bed's edge");
  refused({"run", "cone.toml", "--unset", "source.1.stop"}, "source.1.stop is missing, and no [stroke]");
  refused({"run", "cone.toml", "--unset", "source.1.rate"}, "source.1.rate is missing");
  refused({"run", "cone.toml", "--unset", "source.2.at"}, "source.2.at is missing");
  refused(set("source.1.radius=-1"), "source.1.radius is -1");
  refused({"run", "cone.toml", "--unset", "source", "--set", "force.density=1500"},
          "force.density applies only where force.law is rft or archimedes");
  refused({"record", "--check", "--feel", "cone.toml"}, "record --feel takes no [[source]]");
}

TEST(CliSource, OfARunThatWasStoppedGoesOn) {
  const fs::path folder = test_folder();
  write_file(folder / "cone.toml", "[bed]\nsize = [0.2, 0.2]\ncells = [100, 100]\n[output]\nframes = 20\n" +
                                       cone + "[[source]]\nat = [0.0, 0.0, 0.5]\nrate = 0.02\nstop = 2.0\n");
  const auto run = [&](std::vector<std::string> words, const Conditions& conditions = {}) {
    words.insert(words.begin(), {"run", "cone.toml"});
    return run_program(words, folder, conditions);
  };
  ASSERT_EQ(run({"-o", "whole.h5"}).exit_code, 0);
  Conditions when_kept{SIGINT};
  when_kept.when = [&] { return fs::exists(folder / "a.h5.state"); };
  const ProgramResult stopped = run({"-o", "a.h5", "--checkpoint", "0.01"}, when_kept);
  if (stopped.exit_code == 0) GTEST_SKIP() << "it ended first";
  ASSERT_EQ(stopped.exit_code, 128 + SIGINT) << stopped.err;
  const ProgramResult on = run({"-o", "a.h5", "--resume"});
  ASSERT_EQ(on.exit_code, 0) << on.err;
  const RunFile whole(folder / "whole.h5"), a(folder / "a.h5");
  EXPECT_TRUE((whole.final() == a.final()).all());
  EXPECT_EQ(whole.frame_times(), a.frame_times());
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(whole.sources()[i].landed, a.sources()[i].landed);
}

}  // namespace
}  // namespace sandstroke
