#include "io/bed_floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "io/input_kind.h"
#include "io/run_file.h"
#include "run_on_stones.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

class BedFloor : public testing::Test {
 protected:
  void write_run(const HeightField& bed, bool interrupted = false) { write_run_on(bed, path_, interrupted); }
  /// The same floor in every cell.
  static void expect_floor_of(const HeightField& bed, const HeightField& read) {
    ASSERT_TRUE(read.ground());
    for (int row = 0; row < bed.rows(); ++row)
      for (int col = 0; col < bed.cols(); ++col)
        ASSERT_EQ(read.floor(row, col), bed.floor(row, col)) << row << " " << col;
  }

  TestFolder folder_;
  const std::filesystem::path path_ = folder_ / "run.h5";
};

TEST_F(BedFloor, EverySurfaceOfARunLiesOnItsFloor) {
  for (const double bottom : {-infinite, -0.02}) {
    const HeightField bed = sand_with_a_stone(150, 200, 0.002, 0.05, -0.01, bottom);
    write_run(bed);
    const RunFile run(path_);
    const HeightField initial = run.initial_bed(), final = run.final_bed();
    expect_floor_of(bed, initial);
    expect_floor_of(bed, final);
    expect_floor_of(bed, RunFrames(run).surface(0));
    EXPECT_TRUE((initial.grid() == bed.grid()).all());
    EXPECT_EQ(final(3, 4), 0.002);
    EXPECT_EQ(final(75, 100), bed.floor(75, 100));  // the stone's top is bare
    EXPECT_EQ(final.ground(), initial.ground()) << "read once";
    EXPECT_EQ(final.ground()->level(), bottom);
    EXPECT_EQ(has_floor(final), true);
  }
}

TEST_F(BedFloor, TheFileHasNumbersOnlyWhereThereIsAFloor) {
  const HeightField bed = sand_with_a_stone(150, 200, 0.002, 0.05, -0.01);
  write_run(bed);
  const Hdf5Reader file(path_);
  const HeightGrid stored = file.grid(floor_dataset);
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      const bool stone = std::isfinite(bed.floor(row, col));
      ASSERT_EQ(!std::isnan(stored(row, col)), stone) << row << " " << col;
      if (stone) {
        ASSERT_EQ(stored(row, col), bed.floor(row, col));
      }
    }
  EXPECT_EQ(file.text_attribute(floor_dataset, "units"), "m");
}

TEST_F(BedFloor, ARunThatIsStillWrittenHasItsFloor) {
  const HeightField bed = sand_with_a_stone(100, 100, 0.002, 0.05);
  constexpr bool interrupted = true;
  write_run(bed, interrupted);
  const RunFile run(path_.string() + ".part");
  expect_floor_of(bed, last_surface(run).surface);
}

TEST_F(BedFloor, ARunWithoutOneHasNoDatasetAndNoGround) {
  HeightField bed(100, 100, 0.002);
  write_run(bed);
  EXPECT_FALSE(Hdf5Reader(path_).has(floor_dataset));
  EXPECT_EQ(RunFile(path_).initial_bed().ground(), nullptr);
  bed.lie_on(std::make_shared<Ground>(bed, 0.6));  // slopes by place alone
  EXPECT_FALSE(has_floor(bed));
  std::filesystem::remove(path_);
  write_run(bed);
  EXPECT_FALSE(Hdf5Reader(path_).has(floor_dataset));
}

TEST_F(BedFloor, AFloorOnOneLevelTakesNoRoom) {
  HeightField bed(4096, 4096, 0.002);
  bed.lie_on(std::make_shared<Ground>(bed, -0.05, 0.6));
  write_run(bed);
  EXPECT_LT(std::filesystem::file_size(path_), 1'000'000u);
  const HeightField read = RunFile(path_).final_bed();
  EXPECT_EQ(read.floor(4095, 17), -0.05);
  EXPECT_EQ(read.ground()->floor.allocated_tiles(), 0);
}

class DamagedFloor : public BedFloor {
 protected:
  void expect_damaged(const HeightGrid& floor, double height, const std::string& words) {
    {
      Hdf5Writer file(path_, output_kind(InputKind::run));
      file.attribute("/", "complete", 1.0);
      file.write("/scene", std::string());
      file.make_group("/surface");
      file.attribute("/surface", "cell_size", 0.1);
      file.write("/surface/initial", HeightGrid::Constant(3, 4, height));
      file.write(floor_dataset, floor);
      file.finish();
    }
    try {
      RunFile(path_).initial_bed();
      ADD_FAILURE() << "should have failed: " << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
};

TEST_F(DamagedFloor, IsRefused) {
  expect_damaged(HeightGrid::Zero(4, 3), 0.0, "differ in shape");
  expect_damaged(HeightGrid::Constant(3, 4, infinite), 0.0, "infinite");
  HeightGrid floor = HeightGrid::Zero(3, 4);
  floor(1, 2) = 0.25;
  expect_damaged(floor, 0.125, "row 1, column 2");
}

}  // namespace
}  // namespace sandstroke
