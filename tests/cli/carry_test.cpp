// Scenes whose tool carries sand.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/run_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// A shovel goes into the sand, lifts, and is tilted above the sand beside it.
fs::path folder_of_shovel() {
  fs::path folder = test_folder();
  write_file(folder / "shovel.toml",
             "[model]\npreset = \"accurate\"\n[bed]\nsize = [0.3, 0.2]\ncells = [75, 50]\n[tool]\n"
             "shape = \"shovel\"\nsize = [0.06, 0.06, 0.025]\nthickness = 0.008\ncarries = true\n[stroke]\n"
             "file = \"spoon.toml\"\n");
  write_file(folder / "spoon.toml",
             "clearance = 0.05\nspeed = 0.2\nplunge_speed = 0.2\nstart = [-0.1, 0.0]\n[[segment]]\nkind = "
             "\"line\"\n"
             "to = [-0.02, 0.0]\ndepth = [0.0, 0.02, 0.02, -0.05]\n[[segment]]\nkind = \"line\"\nto = [0.08, "
             "0.0]\n"
             "depth = -0.05\ntilt = [0.0, 0.0, 60.0]\n");
  return folder;
}

TEST(CliCarry, TellsWhatWasLiftedAndSpilled) {
  const fs::path folder = folder_of_shovel();
  const ProgramResult run = run_program({"run", "shovel.toml", "-o", "a.h5", "--frames", "20"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("on the tool"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("took up"), std::string::npos) << run.out;
  const ProgramResult json = run_program({"run", "shovel.toml", "-o", "b.h5", "--json"}, folder);
  const auto load = nlohmann::json::parse(json.out)["load"];
  EXPECT_GT(load["lifted"].get<double>(), 1e-5);
  EXPECT_GT(load["spilled"].get<double>(), 1e-5);
  EXPECT_EQ(load["in_air"].get<double>(), 0.0);
  EXPECT_NEAR(load["lifted"].get<double>() + load["ran_on"].get<double>() + load["caught"].get<double>(),
              load["spilled"].get<double>() + load["carried"].get<double>(), 1e-15);
  const RunFile file(folder / "a.h5");
  double most = 0.0, heaviest = 0.0;
  for (const TickRecord& tick : file.trace()) {
    most = std::max(most, tick.carried);
    heaviest = std::max(heaviest, tick.load);
  }
  EXPECT_NEAR(most, 1600.0 * load["most"].get<double>(), 0.05 * most);
  EXPECT_NEAR(heaviest, 9.81 * most, 0.2 * heaviest);
  // The file keeps the books, and info tells them.
  const auto told = nlohmann::json::parse(run_program({"info", "a.h5", "--json"}, folder).out)["load"];
  for (const auto& [name, value] : told.items()) EXPECT_EQ(value, load[name]) << name;
  EXPECT_EQ(told.size() + 1, load.size());  // the density is the scene's
  EXPECT_NE(run_program({"info", "a.h5"}, folder).out.find(" m^3"), std::string::npos);
  // Frames have the sand on the tool where there is some.
  int with_load = 0;
  const int frames = static_cast<int>(file.frame_times().size());
  for (int k = 0; k < frames; ++k) with_load += file.load_surface(k).has_value();
  EXPECT_GT(with_load, 3);
  EXPECT_LT(with_load, frames);
  EXPECT_EQ(run_program({"render", "a.h5", "--frame", "8"}, folder).exit_code, 0);
}

TEST(CliCarry, ARunThatWasKilledGoesOnWithTheSameBits) {
  const fs::path folder = folder_of_shovel();
  std::vector<std::string> words = {"run",          "shovel.toml", "-o",       "a.h5",
                                    "--checkpoint", "0.01",        "--frames", "20"};
  Conditions killed;
  killed.signal = SIGKILL;
  killed.when = [&] { return fs::exists(folder / "a.h5.state"); };
  run_program(words, folder, killed);
  words.emplace_back("--resume");
  const ProgramResult run = run_program(words, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_EQ(run_program({"run", "shovel.toml", "-o", "b.h5", "--frames", "20"}, folder).exit_code, 0);
  const RunFile one(folder / "a.h5"), other(folder / "b.h5");
  EXPECT_TRUE((one.final() == other.final()).all());
  for (int k = 0; k < static_cast<int>(other.frame_times().size()); ++k)
    EXPECT_EQ(one.load_surface(k).has_value(), other.load_surface(k).has_value()) << k;
}

TEST(CliCarry, IsRefusedByOneSentence) {
  const fs::path folder = folder_of_shovel();
  const auto refused = [&](const std::vector<std::string>& settings, const std::string& sentence) {
    expect_run_refused("shovel.toml", settings, sentence, folder);
  };
  refused({"relaxation.law=paper"}, "where sand lies on a tool (tool.carries)");
  refused({"tool.thickness=0.004"}, "sand would run through such a wall");
  refused({"tool.thickness=0.03"}, "leaves no room in the shovel");
  refused({"tool.orientation=[90,0,0]"}, "tool.carries: the tool's upper side is no height field");
  const ProgramResult felt = run_program({"record", "--check", "--feel", "shovel.toml"}, folder);
  EXPECT_EQ(felt.exit_code, 2);
  EXPECT_NE(felt.err.find("tool.carries, which record --feel does not know yet"), std::string::npos)
      << felt.err;
}

TEST(CliCarry, WarnsOfSandThatWouldSlideOff) {
  const fs::path folder = folder_of_shovel();
  std::string csv = "t [s],x [m],y [m],z [m]\n";
  for (int k = 0; k <= 2000; ++k) {
    const double t = 1e-3 * k, z = std::min(-0.03 + 0.2 * t, 0.05);
    const double x = k < 1000 ? 0.0 : 0.03 * std::sin(25.0 * (t - 1.0));
    csv += std::to_string(t) + "," + std::to_string(x) + ",0," + std::to_string(z) + "\n";
  }
  write_file(folder / "shaken.csv", csv);
  const ProgramResult run =
      run_program({"run", "shovel.toml", "--stroke", "shaken.csv", "-o", "a.h5"}, folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("[tool: load-slides]"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace sandstroke
