// A stranger's file reaches people's terminals as text only; and its numbers, as numbers or not at
// all.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "core/terminal_text.h"
#include "hdf5/hdf5_file.h"
#include "io/stroke_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// Clears the screen, names the window, writes backwards, and says that all is well.
const std::string hostile =
    "a\x1b[2J\x1b]0;b\x07\xC2\x9B"
    "31m\xE2\x80\xAE"
    "c\xFF\nsandstroke: fine";

void expect_only_text(const ProgramResult& result, const std::string& where) {
  EXPECT_EQ(result.out, terminal_text(result.out)) << where;
  EXPECT_EQ(result.err, terminal_text(result.err)) << where;
  EXPECT_NE((result.out + result.err).find("\\x1b[2J"), std::string::npos)
      << where << result.out << result.err;
  for (const std::string& text : {result.out, result.err})
    EXPECT_EQ(text.find("\nsandstroke: fine"), std::string::npos) << where << text;
}

/// A stroke from nobody knows where.
void write_stroke(const fs::path& path) {
  Stroke stroke;
  stroke.time = {0.0, 0.1};
  stroke.position = {{0.0, 0.0, -0.002}, {0.05, 0.0, -0.002}};
  stroke.source = hostile;
  write_stroke_file(path, stroke);
}

TEST(CliHostileText, IsShownAndNotObeyed) {
  const fs::path folder = test_folder();
  write_stroke(folder / "hostile.h5");
  write_file(folder / "rows.csv", "t,x,y,z\n0,0,0,0\n1,\x1b[2J,0,0\n");
  write_file(folder / "header.csv", "t,x,y,\x1b[2Jz\n0,0,0,0\n");
  write_file(folder / "key.toml", "[bed]\n\"\\u001b[2J\" = 1\n");
  write_file(folder / "value.toml", "[relaxation]\nlaw = \"\\u001b[2J\\nsandstroke: fine\"\n");
  write_file(folder / "bytes.toml", "[bed]\ncells = \x1b[2J\n");
  const std::vector<std::string> convert = {"--time",          "t", "--position",  "x,y,z",
                                            "--position-unit", "m", "--time-unit", "s"};
  const auto of_table = [&](const std::string& table) {
    std::vector<std::string> words = {"stroke", "convert", table, "new.h5"};
    words.insert(words.end(), convert.begin(), convert.end());
    return words;
  };
  const std::string named = "no\x1b[2J.h5";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"stroke", "info", "hostile.h5"},
        of_table("rows.csv"),
        of_table("header.csv"),
        {"run", "key.toml"},
        {"run", "value.toml"},
        {"run", "scene.toml", "--set", "relaxation.law=\x1b[2J\nsandstroke: fine"},
        {"info", named},
        {"stroke", "\x1b[2J"},
        {"run", "scene.toml", "-o", named}})
    expect_only_text(run_program(command, folder), command[0] + " " + command[1]);
  const ProgramResult bytes = run_program({"run", "bytes.toml"}, folder);
  EXPECT_EQ(bytes.exit_code, 2);
  EXPECT_EQ(bytes.err, terminal_text(bytes.err));
}

TEST(CliHostileText, IsWhatItWasAsJson) {
  const fs::path folder = test_folder();
  write_stroke(folder / "hostile.h5");
  const ProgramResult result = run_program({"stroke", "info", "hostile.h5", "--json"}, folder);
  EXPECT_EQ(result.out, terminal_text(result.out));
  const std::string source = nlohmann::json::parse(result.out)["source"];
  EXPECT_EQ(source.substr(0, source.find('\xEF')), hostile.substr(0, hostile.find('\xFF')));
}

TEST(CliHostileText, AFailedPointsReasonIsShownToo) {
  const fs::path folder = test_folder();
  write_file(folder / "plan.toml", "[sweep]\nscene = \"scene.toml\"\n[axes]\ntool.radius = [0.01, 0.02]\n");
  ASSERT_EQ(run_program({"sweep", "plan.toml", "-o", "out"}, folder).exit_code, 0);
  {
    const Hdf5Handle file(H5Fopen((folder / "out/points/000000.h5").c_str(), H5F_ACC_RDWR, without_locks()),
                          H5Fclose);
    const Hdf5Handle text(H5Tcopy(H5T_C_S1), H5Tclose), scalar(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(text, H5T_VARIABLE);
    for (const auto& [name, value] : {std::pair{"verdict", std::string("refused")}, {"reason", hostile}}) {
      ASSERT_GE(H5Adelete(file, name), 0);
      const Hdf5Handle attribute(H5Acreate2(file, name, text, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      const char* letters = value.c_str();
      ASSERT_GE(H5Awrite(attribute, text, &letters), 0);
    }
  }
  for (const char* command : {"status", "collect"})
    expect_only_text(run_program({"sweep", command, "out"}, folder), command);
}

TEST(CliHostileNumbers, AreRefusedInASentence) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--frames", "4"}, folder).exit_code, 0);
  write_file(folder / "log.toml",
             "[sweep]\nscene = \"scene.toml\"\n[axes]\n"
             "force.k_s = { from = 1e-320, to = 1e-310, count = 3, scale = \"log\" }\n");
  EXPECT_EQ(run_program({"sweep", "log.toml", "--dry-run"}, folder).exit_code, 0);
  write_file(folder / "plan.toml",
             "[sweep]\nscene = \"scene.toml\"\n[axes]\nforce.k_s = [500, 9007199254740993]\n");
  write_file(folder / "long.csv", "t,x,y,z\n0,0,0,-0.002\n1e50,0.05,0,-0.002\n");
  ASSERT_EQ(run_program({"stroke", "convert", "long.csv", "long.h5", "--time", "t", "--position", "x,y,z",
                         "--position-unit", "m", "--time-unit", "s", "--gap-threshold", "1e60"},
                        folder)
                .exit_code,
            0);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"run", "scene.toml", "--set", "stroke.depth=9007199254740993"},
        {"run", "scene.toml", "--set", "relaxation.max_passes=9223372036854775807"},
        {"run", "scene.toml", "--threads", "99999999999999999999"},
        {"run", "scene.toml", "--frames", "1e999"},
        {"run", "scene.toml", "--stroke", "long.h5"},
        {"render", "a.h5", "--frame", "99999999999"},
        {"render", "a.h5", "--size", "99999999999x4"},
        {"render", "a.h5", "--azimuth", "nan"},
        {"render", "a.h5", "--elevation", "nan"},
        {"render", "a.h5", "--light-azimuth", "1e308"},
        {"render", "a.h5", "--light-elevation=-1e-320"},
        {"render", "a.h5", "--view", "custom", "--target", "0,nan,0"},
        {"sweep", "plan.toml", "-o", "out"},
        {"sweep", "plan.toml", "-o", "out", "--shard", "1/99999999999"}}) {
    const ProgramResult result = run_program(command, folder);
    EXPECT_EQ(result.exit_code, 2) << command.back() << result.err;
    EXPECT_TRUE(result.err.starts_with("sandstroke: ")) << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
  }
}

}  // namespace
}  // namespace sandstroke
