// Talus angles from a picture, in the real program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/png_file.h"
#include "io/run_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class CliSandMap : public testing::Test {
 protected:
  CliSandMap() {
    write_file(
        folder_ / "sand.toml",
        "[bed]\nsize = [0.375, 0.25]\ncells = [96, 64]\n[bed.surface]\nkind = \"cylinder\"\nradius = "
        "0.06\nheight = 0.06\n[relaxation]\ntalus_angle = 25.0\n[sand.map]\nfile = \"talus.png\"\nlow = "
        "25.0\nhigh = 35.0\n");
    write_picture("talus.png", 48);
  }
  /// Black, and from this column on white.
  void write_picture(const std::string& name, int seam) const {
    HeightGrid shares = HeightGrid::Zero(64, 96);
    shares.rightCols(96 - seam).setConstant(1.0);
    write_file(folder_ / name, encode_height_png(shares, {0.0, 1.0}));
  }
  ProgramResult run(std::vector<std::string> words, int exit_code = 0) const {
    const ProgramResult result = run_program(words, folder_);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    return result;
  }
  HeightGrid final(const std::string& name) const { return RunFile(folder_ / name).final(); }

  const fs::path folder_ = test_folder();
};

TEST_F(CliSandMap, GivesTheBitsOfTheSameRegion) {
  const ProgramResult result = run({"run", "sand.toml", "-o", "map.h5"});
  EXPECT_NE(result.err.find("talus.png: 96 x 64 cells; talus angles 25 to 35 deg"), std::string::npos)
      << result.err;
  std::string text = read_file(folder_ / "sand.toml");
  text.resize(text.find("[sand.map]"));
  write_file(folder_ / "none.toml", text);
  write_file(folder_ / "region.toml",
             text + "[[sand.region]]\ntalus_angle = 35.0\ncentre = [1.0, 0.0]\nsize = [2.0, 2.0]\n");
  run({"run", "region.toml", "-o", "region.h5"});
  run({"run", "none.toml", "-o", "none.h5"});
  EXPECT_TRUE((final("map.h5") == final("region.h5")).all());
  EXPECT_FALSE((final("map.h5") == final("none.h5")).all());
  run({"run", "sand.toml", "-o", "alone.h5", "--threads", "1"});
  EXPECT_TRUE((final("map.h5") == final("alone.h5")).all());
  run({"run", "sand.toml", "-o", "level.h5", "--set", "sand.map.high=25"});
  EXPECT_TRUE((final("level.h5") == final("none.h5")).all());
  // The run file says all of it.
  const std::string scene = run({"info", "map.h5", "--scene"}).out;
  EXPECT_NE(scene.find("[sand.map]\nfile = \"talus.png\"\nlow = 25.0\nhigh = 35.0\n"), std::string::npos)
      << scene;
}

TEST_F(CliSandMap, EachMistakeHasItsSentence) {
  const auto refused = [&](std::vector<std::string> settings, const std::string& sentence) {
    std::vector<std::string> words = {"run", "sand.toml", "-o", "a.h5"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const std::string err = run(words, 2).err;
    EXPECT_NE(err.find(sentence), std::string::npos) << err;
    EXPECT_FALSE(fs::exists(folder_ / "a.h5"));
  };
  refused({"sand.map.low=0"}, "sand.map.low");
  refused({"sand.map.high=90"}, "sand.map.high");
  refused({"bed.size=[0.375, 0.375]", "bed.cells=[96, 96]"},
          "talus.png: has 96 x 64 cells, which a bed of 0.375 m by 0.375 m cannot have without distortion");
  write_file(folder_ / "radians.asc", "ncols 3\nnrows 2\ncellsize 0.1\n0.5 0.5 0.5\n0.5 0.6 0.7\n");
  refused({"sand.map.file=radians.asc"}, "radians.asc: sand.map.low and high are for pictures");
  run({"run", "sand.toml", "-o", "map.h5"});
  refused({"sand.map.file=map.h5"}, "map.h5: is an HDF5 file, and a run file holds no talus angles");
  std::string text = read_file(folder_ / "sand.toml");
  text.resize(text.find("low ="));
  write_file(folder_ / "sand.toml", text);
  refused({}, "talus.png: the picture does not say its angles; set sand.map.low and sand.map.high");
  const std::string err = run({"run", "sand.toml", "-o", "a.h5", "--set", "sand.map.file=radians.asc"}).err;
  EXPECT_NE(err.find("no angle is above 0.7 degrees"), std::string::npos) << err;
  EXPECT_NE(err.find("[sand.map: map-radians]"), std::string::npos) << err;
}

TEST_F(CliSandMap, IsAnInputThatNoOutputReplaces) {
  const std::string picture = read_file(folder_ / "talus.png");
  run({"run", "sand.toml", "-o", "a.h5", "--png", "talus.png", "--overwrite"}, 2);
  EXPECT_EQ(read_file(folder_ / "talus.png"), picture);
}

TEST_F(CliSandMap, AnErrorIsEstimatedAndAChangedMapIsAnotherRun) {
  write_file(folder_ / "sand.toml", read_file(folder_ / "sand.toml") + "[stroke]\nfile = \"line.toml\"\n");
  const std::vector<std::string> words = {
      "run", "sand.toml", "-o", "a.h5", "--resume", "--checkpoint", "60", "--json", "--estimate-error"};
  const Json first = Json::parse(run(words).out);
  EXPECT_GT(first["error_estimate"]["height_rms"], 0.0) << first;
  EXPECT_EQ(Json::parse(run(words).out)["already_complete"], true);
  write_picture("talus.png", 52);
  EXPECT_FALSE(Json::parse(run(words).out).contains("already_complete"));
}

}  // namespace
}  // namespace sandstroke
