#include <fcntl.h>
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/run_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

nlohmann::json info(const fs::path& folder, const std::string& file) {
  return nlohmann::json::parse(run_program({"stroke", "info", file, "--json"}, folder).out);
}

TEST(CliStroke, AScriptCanBePlayedOrConvertedFirstWithTheSameResult) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"stroke", "script", "line.toml", "line.h5"}, folder).exit_code, 0);
  EXPECT_EQ(info(folder, "line.h5")["samples"], info(folder, "line.toml")["samples"]);
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "b.h5", "--stroke", "line.h5"}, folder).exit_code, 0);
  EXPECT_TRUE((RunFile(folder / "a.h5").final() == RunFile(folder / "b.h5").final()).all());
}

TEST(CliStroke, ConvertsAndPlaysThePandaRecording) {
  const fs::path data = fs::path(SANDSTROKE_SHARED_DATA) / "panda_comanip_force_1khz/symbol17_rec2.csv";
  if (!fs::exists(data)) GTEST_SKIP() << "no recordings beside the repository (" << data << ")";
  const fs::path folder = test_folder();
  const ProgramResult convert =
      run_program({"stroke", "convert", data.string(), "panda.h5", "--rate", "1000", "--position",
                   "x_m,y_m,z_m", "--position-unit", "m", "--velocity", "vx_mps,vy_mps,vz_mps",
                   "--velocity-unit", "m/s", "--force", "fx_N,fy_N,fz_N", "--force-unit", "N"},
                  folder);
  ASSERT_EQ(convert.exit_code, 0) << convert.err;
  const nlohmann::json panda = info(folder, "panda.h5");
  EXPECT_EQ(panda["samples"], 8647);
  EXPECT_NEAR(panda["force"][1], 8.1, 0.05);  // SOURCE.md of the data: 8.1 N at most

  const ProgramResult run = run_program({"run", "scene.toml", "-o", "out.h5", "--stroke", "panda.h5", "--set",
                                         "stroke.plane=fit", "--set", "stroke.depth=0.004", "--json"},
                                        folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json result = nlohmann::json::parse(run.out);
  EXPECT_EQ(result["ticks"], 8647);
  EXPECT_GT(result["contact_ticks"], 8000);
  EXPECT_LE(result["volume_drift"], 1e-12);
}

TEST(CliStroke, ConvertsOmniglotWithAnExplicitRuleForEqualTimes) {
  const fs::path data =
      fs::path(SANDSTROKE_SHARED_DATA) / "omniglot_timed_strokes/Greek/character03/0396_01.txt";
  if (!fs::exists(data)) GTEST_SKIP() << "no recordings beside the repository (" << data << ")";
  const fs::path folder = test_folder();
  std::vector<std::string> arguments = {
      "stroke",     "convert", data.string(),     "letter.h5", "--columns",    "x,y,t",
      "--position", "x,y",     "--position-unit", "px",        "--pixel-size", "0.001",
      "--time",     "t",       "--time-unit",     "ms",        "--pen-up",     "BREAK",
      "--skip",     "START",   "--gap-threshold", "0.4"};
  const ProgramResult guess = run_program(arguments, folder);
  EXPECT_EQ(guess.exit_code, 2);
  EXPECT_NE(guess.err.find("equal-times"), std::string::npos) << guess.err;
  for (const char* letter : {"character03/0396_01", "character10/0403_05", "character21/0414_02"}) {
    arguments[2] = (data.parent_path().parent_path() / (std::string(letter) + ".txt")).string();
    std::vector<std::string> explicit_rule = arguments;
    explicit_rule.insert(explicit_rule.end(), {"--equal-times", "spread", "--overwrite"});
    const ProgramResult convert = run_program(explicit_rule, folder);
    ASSERT_EQ(convert.exit_code, 0) << convert.err;
    EXPECT_EQ(info(folder, "letter.h5")["gaps"].size(),
              letter == std::string("character10/0403_05") ? 2u : 0u);
    const ProgramResult run =
        run_program({"run", "scene.toml", "-o", "out.h5", "--stroke", "letter.h5", "--set",
                     "stroke.plane=fit", "--set", "stroke.depth=0.004", "--png", "out.png", "--json"},
                    folder);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_LE(nlohmann::json::parse(run.out)["volume_drift"], 1e-12);
    EXPECT_LT(RunFile(folder / "out.h5").final().minCoeff(), -0.002);
  }
}

/// A robot's log: semicolons, decimal commas, ms and mm, with y up.
std::string log_of_a_robot() {
  std::string text = "Zeit [ms];x [mm];y [mm];z [mm];Fx (N);Fy (N);Fz (N)\r\n";
  for (int i = 0; i <= 50; ++i) text += fmt::format("{};{},5;-4;{},25;0;1,5;0\r\n", 10 * i, i - 25, i % 2);
  return text;
}

TEST(CliStroke, ATableIsPlayedInOneLineAsIfConvertedFirst) {
  const fs::path folder = test_folder();
  write_file(folder / "log.csv", log_of_a_robot());
  const ProgramResult convert = run_program(
      {"stroke", "convert", "log.csv", "log.h5", "--position", "x,-z,y", "--force-sign", "on device"},
      folder);
  ASSERT_EQ(convert.exit_code, 0) << convert.err;
  const std::string last =
      "I log.csv: semicolons, decimal commas, 7 columns, 51 rows; position x [mm], -z [mm], y [mm] "
      "(mm); force Fx (N), -Fz (N), Fy (N) (N); time Zeit [ms] (ms)\n";
  EXPECT_TRUE(convert.err.ends_with(last)) << convert.err;
  EXPECT_EQ(convert.err.find("W "), std::string::npos) << convert.err;
  EXPECT_EQ(info(folder, "log.h5")["samples"], 51);
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--stroke", "log.h5"}, folder).exit_code, 0);
  const ProgramResult run = run_program(
      {"run", "scene.toml", "-o", "b.h5", "--stroke", "log.csv", "--set", "stroke.table.position=x,-z,y"},
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("stroke.table.force_sign"), std::string::npos) << run.err;  // it was not said here
  EXPECT_TRUE((RunFile(folder / "a.h5").final() == RunFile(folder / "b.h5").final()).all());
  EXPECT_LT(RunFile(folder / "b.h5").final().minCoeff(), -0.002);
}

TEST(CliStroke, InfoShowsOfATableWhatConvertWouldMakeOfIt) {
  const fs::path folder = test_folder();
  write_file(folder / "log.csv", log_of_a_robot());
  write_file(folder / "path.thr", "0 0\n3 0.5\n6 1\n");
  const std::vector<std::vector<std::string>> cases = {
      {"log.csv"},
      {"log.csv", "--position", "x,-z,y", "--force", "none", "--rate", "50"},
      {"path.thr", "--position-unit", "0.2", "--speed", "0.1"}};
  for (std::vector<std::string> options : cases) {
    const std::string file = options.front();
    std::vector<std::string> convert = {"stroke", "convert", file, "made.h5", "--overwrite"};
    convert.insert(convert.end(), options.begin() + 1, options.end());
    options.insert(options.begin(), {"stroke", "info", "--json"});
    const ProgramResult shown = run_program(options, folder);
    ASSERT_EQ(shown.exit_code, 0) << shown.err;
    ASSERT_EQ(run_program(convert, folder).exit_code, 0);
    nlohmann::json of_table = nlohmann::json::parse(shown.out), of_stroke = info(folder, "made.h5");
    EXPECT_EQ(of_stroke["source"], file);
    of_table.erase("file");
    of_stroke.erase("file");
    EXPECT_EQ(of_table, of_stroke);
    EXPECT_NE(shown.err.find("I " + file + ": "), std::string::npos) << shown.err;  // what was found
  }
  const ProgramResult recorded = run_program({"stroke", "info", "made.h5", "--rate", "50"}, folder);
  EXPECT_EQ(recorded.exit_code, 2);
  EXPECT_NE(recorded.err.find("made.h5: is a recorded stroke, which --rate does not change"),
            std::string::npos)
      << recorded.err;
  EXPECT_EQ(run_program({"stroke", "info", "line.toml", "--rate", "50"}, folder).exit_code, 2);
}

/// A log of 10 Hz is one furrow, not one per sample.
TEST(CliStroke, ASlowLogIsNotCutIntoDashes) {
  const fs::path folder = test_folder();
  std::string text = "t [s],x [m],y [m],z [m]\n";
  for (int i = 0; i < 200; ++i)
    text += fmt::format("{:.6f},{:.6f},0,-0.004\n", 0.1 * i + 0.004 * ((7 * i) % 3), 0.001 * i);
  write_file(folder / "slow.csv", text);
  const ProgramResult convert = run_program({"stroke", "convert", "slow.csv", "slow.h5"}, folder);
  ASSERT_EQ(convert.exit_code, 0) << convert.err;
  EXPECT_EQ(info(folder, "slow.h5")["gaps"].size(), 0u);
  EXPECT_NE(convert.err.find("5 times the usual spacing"), std::string::npos) << convert.err;
  EXPECT_EQ(convert.err.find("W "), std::string::npos) << convert.err;
  const ProgramResult dashed =
      run_program({"stroke", "convert", "slow.csv", "dashed.h5", "--gap-threshold", "0.1"}, folder);
  EXPECT_NE(dashed.err.find("its furrow is dashed"), std::string::npos) << dashed.err;
}

TEST(CliStroke, ATableCanComeThroughAPipe) {
  const fs::path folder = test_folder();
  write_file(folder / "log.csv", log_of_a_robot());
  const ProgramResult convert = run_program({"stroke", "convert", "-", "log.h5"}, folder, {.in_child = [&] {
                                              const int file = open((folder / "log.csv").c_str(), O_RDONLY);
                                              dup2(file, 0);
                                            }});
  ASSERT_EQ(convert.exit_code, 0) << convert.err;
  EXPECT_EQ(info(folder, "log.h5")["samples"], 51);
}

TEST(CliStroke, RunPlaysATableThatComesThroughAPipe) {
  const fs::path folder = test_folder();
  write_file(folder / "log.csv", log_of_a_robot());
  const Conditions piped{.in_child = [&] {
    int ends[2];
    if (pipe(ends) == 0) dup2(ends[0], 0);
    const std::string log = log_of_a_robot();
    if (write(ends[1], log.data(), log.size()) < 0) return;  // it fits into the pipe
    close(ends[1]);
  }};
  const std::string axes = "stroke.table.position=x,-z,y";
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--stroke", "log.csv", "--set", axes}, folder)
                .exit_code,
            0);
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "b.h5", "--stroke", "-", "--set", axes}, folder, piped);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("standard input: "), std::string::npos) << run.err;
  const RunFile from_file(folder / "a.h5"), from_pipe(folder / "b.h5");
  EXPECT_TRUE((from_file.final() == from_pipe.final()).all());
  const auto hash = [](const RunFile& file) {
    for (const auto& [name, value] : file.provenance())
      if (name == "stroke_hash") return value;
    return std::string();
  };
  EXPECT_EQ(hash(from_file), hash(from_pipe));
  EXPECT_NE(from_pipe.scene_text().find("file = \"-\""), std::string::npos);
  EXPECT_EQ(run_program({"info", "b.h5"}, folder).exit_code, 0);

  write_file(folder / "waits.toml", "[stroke]\nfile = \"-\"\n");
  const ProgramResult refused = run_program({"run", "waits.toml", "-o", "c.h5"}, folder, piped);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--stroke -"), std::string::npos) << refused.err;
}

TEST(CliStroke, ASecondTableIsAnInputThatNoOutputReplaces) {
  const fs::path folder = test_folder();
  write_file(folder / "tip.csv", "t_s,x_m,y_m,z_m\n0,-0.05,0,-0.004\n0.05,0,0,-0.004\n0.1,0.05,0,-0.004\n");
  const std::string force = "t_s,fx_N,fy_N,fz_N\n0,0,0,1\n0.1,0,0,2\n";
  write_file(folder / "force.h5", force);  // the ending of an output
  const std::string merge = "stroke.table.merge=force.h5";
  const ProgramResult run = run_program(
      {"run", "scene.toml", "-o", "force.h5", "--stroke", "tip.csv", "--set", merge, "--overwrite"}, folder);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  const ProgramResult convert =
      run_program({"stroke", "convert", "tip.csv", "force.h5", "--merge", "force.h5", "--overwrite"}, folder);
  EXPECT_EQ(convert.exit_code, 2) << convert.err;
  EXPECT_EQ(read_file(folder / "force.h5"), force);
}

TEST(CliStroke, ConvertDescribesTheStrokeAsInfoDoes) {
  const fs::path folder = test_folder();
  write_file(folder / "log.csv", log_of_a_robot());
  const ProgramResult convert = run_program({"stroke", "convert", "log.csv", "log.h5", "--json"}, folder);
  ASSERT_EQ(convert.exit_code, 0) << convert.err;
  EXPECT_EQ(nlohmann::json::parse(convert.out), info(folder, "log.h5"));
}

}  // namespace
}  // namespace sandstroke
