// Scenes of moist sand.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program.h"
#include "io/run_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string cake =
    "[model]\npreset = \"accurate\"\n[bed]\nsize = [0.2, 0.2]\ncells = [100, 100]\n[bed.surface]\n"
    "kind = \"cylinder\"\nradius = 0.06\nheight = 0.05\n";

fs::path folder_of_cake() {
  fs::path folder = test_folder();
  write_file(folder / "cake.toml", cake + "[moisture]\ncohesion = 150.0\n");
  return folder;
}

// 7.1 c / gamma of the default sand's density and a talus of 30 degrees: 63 mm.
TEST(CliMoisture, ACakeStandsOrFailsByItsCohesion) {
  const fs::path folder = folder_of_cake();
  std::string told;
  const auto highest = [&](const std::string& cohesion) {
    const ProgramResult run =
        run_program({"run", "cake.toml", "-o", "a.h5", "--set", "moisture.cohesion=" + cohesion}, folder);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(run.err.empty()) << run.err;
    const RunFile file(folder / "a.h5");
    told = run.out;
    return std::pair((file.final() == file.initial()).all(), file.final()(50, 50));
  };
  EXPECT_EQ(highest("150"), std::pair(true, 0.05));
  EXPECT_NE(told.find("no cut failed"), std::string::npos) << told;
  EXPECT_EQ(highest("100"), std::pair(false, 0.05));  // the rim fails, not its middle
  EXPECT_NE(told.find("cuts failed: "), std::string::npos) << told;
  // No cohesion: dry.
  highest("0");
  EXPECT_EQ(told.find("moist sand"), std::string::npos) << told;
  const HeightGrid dry = RunFile(folder / "a.h5").final();
  ASSERT_EQ(run_program({"run", "cake.toml", "-o", "b.h5", "--unset", "moisture"}, folder).exit_code, 0);
  EXPECT_TRUE((RunFile(folder / "b.h5").final() == dry).all());
}

TEST(CliMoisture, SaysThatCellsAreTooLargeForIt) {
  const fs::path folder = folder_of_cake();
  const ProgramResult run =
      run_program({"run", "cake.toml", "-o", "a.h5", "--set", "moisture.cohesion=30", "--json"}, folder);
  EXPECT_EQ(run.exit_code, 0);
  const Json warnings = Json::parse(run.out)["warnings"];
  ASSERT_EQ(warnings.size(), 1u) << warnings;
  EXPECT_EQ(warnings[0]["code"], "moisture-coarse");
  EXPECT_NE(run.err.find("6.6 cells"), std::string::npos) << run.err;
}

TEST(CliMoisture, ARunThatWasKilledGoesOnWithTheSameBits) {
  const fs::path folder = test_folder();
  write_file(folder / "moist.toml",
             read_file(folder / "scene.toml") + "[moisture]\ncohesion = 150.0\ndries = 100.0\n");
  const std::vector<std::string> words = {"run",          "moist.toml", "--set",    "model.preset=accurate",
                                          "-o",           "a.h5",       "--set",    "stroke.depth=0.03",
                                          "--checkpoint", "0.01",       "--frames", "20"};
  Conditions killed;
  killed.signal = SIGKILL;
  killed.when = [&] { return fs::exists(folder / "a.h5.state"); };
  run_program(words, folder, killed);
  std::vector<std::string> resumed = words;
  resumed.emplace_back("--resume");
  const ProgramResult run = run_program(resumed, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::vector<std::string> whole = words;
  whole[5] = "b.h5";
  ASSERT_EQ(run_program(whole, folder).exit_code, 0);
  EXPECT_TRUE((RunFile(folder / "a.h5").final() == RunFile(folder / "b.h5").final()).all());
}

TEST(CliMoisture, IsRefusedByOneSentence) {
  const fs::path folder = folder_of_cake();
  const auto refused = [&](const std::vector<std::string>& settings, const std::string& sentence) {
    expect_run_refused("cake.toml", settings, sentence, folder);
  };
  refused({"relaxation.law=paper"}, "does not go with relaxation.law = \"paper\"");
  refused({"moisture.friction_angle=2"}, "moisture.friction_angle");
  refused({"relaxation.talus_angle=70"}, "a friction angle of 70 deg (relaxation.talus_angle)");
  refused({"moisture.dries=1"}, "moisture.dries needs time");
  refused({"moisture.cohesion=5001"}, "moisture.cohesion");
  refused({"moisture.cohesion=-1"}, "moisture.cohesion");
  write_file(folder / "cake.toml", cake + "[moisture]\nheals = false\n");
  refused({}, "moisture.cohesion is missing");
  write_file(folder / "cake.toml", cake + "[[sand.region]]\ncohesion = 100.0\n");
  refused({}, "sand.region.1.cohesion applies only where there is a [moisture]; add that section");
  write_file(folder / "felt.toml", read_file(folder / "scene.toml") +
                                       "[moisture]\ncohesion = 150.0\n[relaxation]\nlaw = \"faces\"\n");
  const ProgramResult felt = run_program({"record", "--check", "--feel", "felt.toml"}, folder);
  EXPECT_EQ(felt.exit_code, 2);
  EXPECT_NE(felt.err.find("[moisture], which record --feel does not know yet"), std::string::npos)
      << felt.err;
}

TEST(CliMoisture, RegionsHaveAWeightOfTheirOwn) {
  const fs::path folder = test_folder();
  const auto fails = [&](double density) {
    write_file(folder / "cake.toml",
               cake +
                   "[moisture]\ncohesion = 150.0\n[[sand.region]]\ncentre = [0.0, 0.25]\n"
                   "size = [0.5, 0.5]\ndensity = " +
                   std::to_string(density) + "\n");
    const ProgramResult run = run_program({"run", "cake.toml", "-o", "a.h5"}, folder);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const RunFile file(folder / "a.h5");
    EXPECT_TRUE((file.final().topRows(30) == file.initial().topRows(30)).all());  // y < 0: as light as ever
    return !(file.final() == file.initial()).all();
  };
  EXPECT_FALSE(fails(1600.0));
  EXPECT_TRUE(fails(2400.0));  // as with two thirds of the cohesion
}

TEST(CliMoisture, SaysThatCellsAreTooLargeForARegion) {
  const fs::path folder = test_folder();
  write_file(folder / "cake.toml", cake +
                                       "[moisture]\ncohesion = 0.0\n[[sand.region]]\ncentre = [0.0, 0.25]\n"
                                       "size = [0.5, 0.5]\ncohesion = 30.0\n");
  const ProgramResult run = run_program({"run", "cake.toml", "-o", "a.h5"}, folder);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.err.find("6.6 cells"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("or more sand.region.1.cohesion"), std::string::npos) << run.err;
}

TEST(CliMoisture, RegionsHaveACohesionOfTheirOwn) {
  const fs::path folder = test_folder();
  write_file(folder / "cake.toml", cake +
                                       "[moisture]\ncohesion = 150.0\n[[sand.region]]\ncentre = [0.0, 0.25]\n"
                                       "size = [0.5, 0.5]\ncohesion = 0.0\n");
  const ProgramResult run = run_program({"run", "cake.toml", "-o", "a.h5"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const RunFile file(folder / "a.h5");
  const HeightGrid before = file.initial(), after = file.final();
  EXPECT_TRUE((after.topRows(30) == before.topRows(30)).all());  // y < 0: moist
  EXPECT_FALSE((after.bottomRows(40) == before.bottomRows(40)).all());
}

TEST(CliMoisture, ASweepFindsWhereItFailsAndWeightCountsAsCohesionDoes) {
  const fs::path folder = folder_of_cake();
  write_file(folder / "sweep.toml",
             "[sweep]\nscene = \"cake.toml\"\n[axes]\nmoisture.cohesion = [100, 150]\n"
             "force.density = [1600, 2400]\n");
  const ProgramResult sweep = run_program({"sweep", "sweep.toml", "-o", "out"}, folder);
  ASSERT_EQ(sweep.exit_code, 0) << sweep.err;
  std::istringstream csv(read_file(folder / "out/sweep.csv"));
  const auto next_row = [&] {
    std::string line, word;
    std::getline(csv, line);
    std::istringstream words(line);
    std::vector<std::string> row;
    while (std::getline(words, word, ',')) row.push_back(word);
    return row;
  };
  const std::vector<std::string> names = next_row();
  const std::ptrdiff_t column = std::find(names.begin(), names.end(), "failed_volume") - names.begin();
  ASSERT_LT(column, std::ssize(names));
  std::vector<double> failed(4);
  for (double& volume : failed) volume = std::stod(next_row().at(column));
  EXPECT_GT(failed[0], 0.0);                            // 100 Pa at 1600 kg/m^3
  EXPECT_GT(failed[1], 0.0);                            // 100 Pa at 2400 kg/m^3
  EXPECT_EQ(failed[2], 0.0);                            // 150 Pa at 1600 kg/m^3
  EXPECT_NEAR(failed[3], failed[0], 1e-9 * failed[0]);  // the same cohesion over the weight
}

}  // namespace
}  // namespace sandstroke
