// What commands make of a run whose bed has stones.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/png_file.h"
#include "real_client.h"
#include "run_on_stones.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class CliStones : public testing::Test {
 protected:
  CliStones() {
    write_run_on(stone_, folder_ / "stone.h5");
    write_run_on(HeightField(stone_.grid(), stone_.cell_size()), folder_ / "sand.h5");
  }
  ProgramResult run(const std::vector<std::string>& words, int exit_code = 0) {
    const ProgramResult result = run_program(words, folder_);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    return result;
  }

  const fs::path folder_ = test_folder();
  const HeightField stone_ = sand_with_a_stone(100, 150, 0.002, 0.05, -0.02);
};

TEST_F(CliStones, AreNamedByInfoAndCompare) {
  const auto facts = nlohmann::json::parse(run({"info", "stone.h5", "--json"}).out);
  EXPECT_EQ(facts["floor"]["highest"], stone_.ground()->floor.highest());
  EXPECT_GT(facts["floor"]["cells"], 1900);  // of pi 25^2 = 1963
  EXPECT_LT(facts["floor"]["cells"], 2030);
  EXPECT_FALSE(nlohmann::json::parse(run({"info", "sand.h5", "--json"}).out).contains("floor"));
  EXPECT_NE(run({"compare", "stone.h5", "sand.h5"}, 1).out.find("floor"), std::string::npos);
  EXPECT_NE(run({"compare", "stone.h5", "stone.h5"}).out.find("floor"), std::string::npos);
}

TEST_F(CliStones, AreGrayInPictures) {
  run({"render", "stone.h5", "-o", "stone.png", "--no-tool", "--view", "top"});
  run({"render", "sand.h5", "-o", "sand.png", "--no-tool", "--view", "top"});
  const Image stone = read_png(folder_ / "stone.png"), sand = read_png(folder_ / "sand.png");
  const auto warmth = [](const Image& image) {
    double sum = 0.0;
    for (int y = image.height / 2 - 10; y < image.height / 2 + 10; ++y)
      for (int x = image.width / 2 - 10; x < image.width / 2 + 10; ++x)
        sum += image.pixel(x, y)[0] - image.pixel(x, y)[2];
    return sum / 400.0;
  };
  EXPECT_LT(std::abs(warmth(stone)), 20.0);
  EXPECT_GT(warmth(sand), 45.0);
}

TEST_F(CliStones, AreInExportsWithTheFloorAsALayerOfItsOwn) {
  run({"export", "stone.h5", "-o", "final.npy"});
  run({"export", "stone.h5", "-o", "floor.npy", "--frame", "floor"});
  run({"export", "stone.h5", "-o", "floor.asc", "--frame", "floor"});
  SANDSTROKE_NEEDS(python_has("numpy"), "python3-numpy");
  const auto read = run_child(
      {python, "-c",
       "import sys, numpy as np\n"
       "folder = sys.argv[1] + '/'\n"
       "final, floor = np.load(folder + 'final.npy'), np.load(folder + 'floor.npy')\n"
       "asc = np.loadtxt(folder + 'floor.asc', skiprows=6)[::-1]\n"
       "assert ((asc == -9999) == np.isnan(floor)).all()\n"
       "assert (asc[asc != -9999] == floor[asc != -9999]).all()\n"
       "assert (final[final == floor] > 0).all() and (final >= np.nan_to_num(floor, nan=-1)).all()\n"
       "print((final == floor).sum())\n",
       folder_.string()});
  ASSERT_EQ(read->exit_code, 0) << read->err;
  int bare = 0;
  for (int row = 0; row < stone_.rows(); ++row)
    for (int col = 0; col < stone_.cols(); ++col) bare += stone_(row, col) == stone_.floor(row, col);
  EXPECT_EQ(std::stoi(read->out), bare);
  EXPECT_GT(bare, 100);
  for (const std::string name : {"floor.png", "floor.stl"})
    EXPECT_NE(run({"export", "stone.h5", "-o", name, "--frame", "floor"}, 2).err.find("no floor, which only"),
              std::string::npos);
  EXPECT_NE(run({"export", "sand.h5", "-o", "floor2.npy", "--frame", "floor"}, 2).err.find("has no floor"),
            std::string::npos);
}

TEST_F(CliStones, BecomeSandInASceneWithoutThemWhichAWarningSays) {
  write_text_file(
      folder_ / "again.toml",
      "[bed]\nsize = [0.3, 0.2]\ncells = [150, 100]\nsurface.kind = \"file\"\nsurface.file = \"stone.h5\"\n");
  const std::string said = run({"run", "again.toml", "-o", "again.h5"}).err;
  EXPECT_NE(said.find("stone.h5: has stones or a floor"), std::string::npos) << said;
  EXPECT_EQ(
      run({"run", "again.toml", "-o", "other.h5", "--set", "bed.surface.file=sand.h5"}).err.find("stones"),
      std::string::npos);
}

}  // namespace
}  // namespace sandstroke
