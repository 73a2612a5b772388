#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include "cli/program.h"
#include "core/machine.h"
#include "hdf5/hdf5_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr int huge_side = 1 << 16, small_side = 1 << 10;
constexpr double cell_size = 0x1p-9;  // m; a power of two: cell centres are exact on both beds

std::string scene_of(int side) {
  return fmt::format("[bed]\nsize = [{0}, {0}]\ncells = [{1}, {1}]\n[stroke]\nfile = \"line.toml\"\n",
                     side * cell_size, side);
}

/// A folder with huge.toml and small.toml: the same stroke on beds with the same cells.
fs::path folder_with_beds() {
  const fs::path folder = test_folder();
  write_file(folder / "huge.toml", scene_of(huge_side));
  write_file(folder / "small.toml", scene_of(small_side));
  return folder;
}

/// side x side heights from (row, col) on: what a reader sees who does not load the whole surface.
HeightGrid part_of(const fs::path& run, const std::string& dataset, int row, int col, int side) {
  prepare_hdf5();
  const Hdf5Handle file(H5Fopen(run.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
  const Hdf5Handle opened(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(opened), H5Sclose);
  const hsize_t first[2] = {static_cast<hsize_t>(row), static_cast<hsize_t>(col)};
  const hsize_t count[2] = {static_cast<hsize_t>(side), static_cast<hsize_t>(side)};
  const Hdf5Handle memory(H5Screate_simple(2, count, nullptr), H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, first, nullptr, count, nullptr);
  HeightGrid part = HeightGrid::Constant(side, side, std::nan(""));
  EXPECT_GE(H5Dread(opened, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, part.data()), 0);
  return part;
}

/// The huge bed's cells that correspond to the small bed's.
HeightGrid middle_of(const fs::path& run, const std::string& dataset) {
  constexpr int first = (huge_side - small_side) / 2;
  return part_of(run, dataset, first, first, small_side);
}

TEST(CliHugeBed, AStrokeCostsWhatItCostsOnASmallBed) {
  const fs::path folder = folder_with_beds();
  const ProgramResult huge = run_program({"run", "huge.toml", "--threads", "1", "--frames", "10"}, folder),
                      small = run_program({"run", "small.toml", "--threads", "1", "--frames", "10"}, folder);
  ASSERT_EQ(huge.exit_code, 0) << huge.err;
  ASSERT_EQ(small.exit_code, 0) << small.err;
  // Its heights would take 34 GB, the table of its tiles 4 MB.
  EXPECT_LT(huge.peak_memory, small.peak_memory + 20e6);
  EXPECT_LT(static_cast<double>(fs::file_size(folder / "huge.h5")),
            1.1 * static_cast<double>(fs::file_size(folder / "small.h5")));
  EXPECT_LT(fs::file_size(folder / "huge.h5"), 5'000'000u);

  const HeightGrid on_huge = middle_of(folder / "huge.h5", "/surface/final"),
                   on_small = part_of(folder / "small.h5", "/surface/final", 0, 0, small_side);
  EXPECT_LT(on_small.minCoeff(), -0.001);
  EXPECT_TRUE((on_huge == on_small).all());
  for (const int row : {0, huge_side - 64})
    for (const int col : {0, huge_side - 64})
      EXPECT_TRUE((part_of(folder / "huge.h5", "/surface/final", row, col, 64) == 0.0).all());
  EXPECT_TRUE((middle_of(folder / "huge.h5", "/surface/initial") == 0.0).all());
}

TEST(CliHugeBed, WhatWouldTakeAllOfItIsRefusedAtOnce) {
  if (physical_memory() > 100e9) GTEST_SKIP() << "this machine has memory for it";
  const fs::path folder = folder_with_beds();
  ASSERT_EQ(run_program({"run", "huge.toml"}, folder).exit_code, 0);
  const double peak =  // with all libraries
      run_program({"run", "scene.toml", "-o", "drawn.h5", "--png", "drawn.png"}, folder).peak_memory;
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& part) {
    const ProgramResult result = run_program(arguments, folder);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_LT(result.peak_memory, 1.5 * peak) << arguments.front();
  };
  refused({"render", "huge.h5"}, "65536 x 65536 cells cannot be drawn");
  refused({"run", "huge.toml", "-o", "a.h5", "--png", "a.png"}, "65536 x 65536 cells cannot be drawn");
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
  refused({"run", "small.toml", "-o", "a.h5", "--set", "bed.surface={kind='file', file='huge.h5'}"},
          "huge.h5: is a bed of 65536 x 65536 cells, 128 m by 128 m, but bed.size = [2, 2]");
  refused({"run", "huge.toml", "-o", "a.h5", "--set", "bed.surface={kind='noise', wavelength=0.0}"},
          "GB of memory");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", "huge.h5"},
        {"report", "huge.h5"},
        {"compare", "huge.h5", "huge.h5", "--report", "report"}}) {
    const ProgramResult result = run_program(arguments, folder);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_LT(result.peak_memory, 1.5 * peak) << arguments.front();
  }
}

}  // namespace
}  // namespace sandstroke
