// Beds that begin as maps, in the real program: what goes out comes in again, and a hostile file costs
// nothing.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include "cli/program.h"
#include "io/png_file.h"
#include "io/run_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr int map_rows = 20, map_cols = 30;

/// A map of 30 x 20 cells of 1 cm with gentle waves. Two cells have no data.
std::string map_text() {
  std::string text =
      "ncols 30\nnrows 20\nxllcorner 340620\nyllcorner 3917730\ncellsize 0.01\nNODATA_value -9999\n";
  for (int row = 0; row < map_rows; ++row)
    for (int col = 0; col < map_cols; ++col)
      text += row == 3 && (col == 7 || col == 8) ? "-9999\n"
                                                 : fmt::format("{}\n", 1e-4 * ((7 * row + 3 * col) % 11));
  return text;
}

ProgramResult run_from(const fs::path& folder, const std::string& file, const std::string& output,
                       const Words& settings = {}) {
  Words words = {"run",   "flat.toml",
                 "-o",    output,
                 "--set", "bed.surface.kind=file",
                 "--set", "bed.surface.file=" + file};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  return run_program(words, folder);
}

fs::path folder_with_map() {
  const fs::path folder = test_folder();
  write_file(folder / "flat.toml", "[bed]\nsize = [0.3, 0.2]\ncells = [30, 20]\n");
  write_file(folder / "map.asc", map_text());
  return folder;
}

void expect_says(const ProgramResult& result, int exit_code, const std::string& part) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
}

TEST(CliSurfaceMap, WhatAMapBecameGoesOutAndComesInAgain) {
  const fs::path folder = folder_with_map();
  expect_says(
      run_from(folder, "map.asc", "a.h5"), 2,
      "map.asc: 2 of the bed's 600 cells have no height (no data, or not a number); set bed.surface.nodata");
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
  expect_says(run_from(folder, "map.asc", "a.h5", {"bed.surface.nodata=0.0005"}), 0,
              "map.asc: 30 x 20 cells of 0.01 m; 2 cells without data were set to 0.0005 m");
  const RunFile first(folder / "a.h5");
  EXPECT_EQ(first.initial()(map_rows - 1 - 3, 7), 0.0005);
  EXPECT_EQ(first.initial()(map_rows - 1 - 4, 7), 1e-4 * ((7 * 4 + 3 * 7) % 11));
  for (const std::string ending : {".asc", ".npy"}) {
    ASSERT_EQ(run_program({"export", "a.h5", "-o", "a" + ending}, folder).exit_code, 0);
    ASSERT_EQ(run_from(folder, "a" + ending, "b.h5").exit_code, 0) << ending;
    EXPECT_TRUE((RunFile(folder / "b.h5").initial() == first.final()).all()) << ending;
    fs::remove(folder / "b.h5");
  }
}

TEST(CliSurfaceMap, OtherCellsKeepTheVolumeAndAreSaid) {
  const fs::path folder = folder_with_map();
  ASSERT_EQ(run_from(folder, "map.asc", "a.h5", {"bed.surface.nodata=0"}).exit_code, 0);
  const double volume = RunFile(folder / "a.h5").initial_bed().volume();
  expect_says(run_from(folder, "map.asc", "b.h5", {"bed.surface.nodata=0", "bed.cells=[48, 32]"}), 0,
              "30 x 20 cells of 0.01 m fitted to 48 x 32 cells of 0.00625 m");
  EXPECT_NEAR(RunFile(folder / "b.h5").initial_bed().volume() / volume, 1.0, 1e-12);
  // So do those of a run.
  expect_says(run_from(folder, "a.h5", "c.h5", {"bed.cells=[48, 32]"}), 0,
              "30 x 20 cells fitted to 48 x 32 cells");
  EXPECT_NEAR(RunFile(folder / "c.h5").initial_bed().volume() / RunFile(folder / "a.h5").final_bed().volume(),
              1.0, 1e-12);
  expect_says(run_from(folder, "map.asc", "d.h5", {"bed.size=[0.6, 0.4]"}), 2, "set bed.surface.scale = 2");
  const ProgramResult scaled = run_from(
      folder, "map.asc", "d.h5", {"bed.size=[0.6, 0.4]", "bed.surface.scale=2", "bed.surface.nodata=0"});
  expect_says(scaled, 0, "at scale 2; heights 0 to 0.001 m became 0 to 0.002 m");
  // The run file says all of it.
  const SurfaceSettings kept = RunFile(folder / "d.h5").scene().bed.surface;
  EXPECT_EQ(kept.scale, 2.0);
  EXPECT_EQ(kept.nodata, 0.0);
}

TEST(CliSurfaceMap, ALargePngTakesTheMemoryOfARow) {
  const fs::path folder = folder_with_map();
  write_file(folder / "small.png", encode_height_png(HeightGrid::Zero(20, 30), {0.0, 0.01}));
  write_file(folder / "large.png", encode_height_png(HeightGrid::Zero(4000, 6000), {0.0, 0.01}));
  write_file(folder / "long.png", encode_height_png(HeightGrid::Zero(2000, 16000), {0.0, 0.01}));
  const ProgramResult small = run_from(folder, "small.png", "a.h5"),
                      large = run_from(folder, "large.png", "b.h5"),
                      refused = run_from(folder, "long.png", "c.h5");
  EXPECT_EQ(small.exit_code, 0) << small.err;
  expect_says(large, 0, "6000 x 4000 cells fitted to 30 x 20 cells");
  expect_says(refused, 2, "long.png: has 16000 x 2000 cells, which a bed of 0.3 m by 0.2 m cannot have");
  for (const ProgramResult& result : {large, refused})
    EXPECT_LT(result.peak_memory, 1.1 * small.peak_memory + 4e6);
}

}  // namespace
}  // namespace sandstroke
