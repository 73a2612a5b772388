#include "io/bed_writer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "any_hdf5.h"
#include "core/output_file.h"
#include "hdf5/hdf5_file.h"
#include "sand/initial_surface.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class BedWriter : public testing::Test {
 protected:
  HeightGrid written(const HeightField& bed) {
    Hdf5Writer file(path_, any_hdf5);
    write_bed(file, "/bed", bed);
    file.finish();
    return Hdf5Reader(path_).grid("/bed");
  }
  TestFolder folder_;
  const fs::path path_ = folder_ / "bed.h5";
};

SurfaceSettings surface_of(SurfaceKind kind) {
  SurfaceSettings surface;
  surface.kind = kind;
  return surface;
}

TEST_F(BedWriter, EverySurfaceReadsAsItsGridWhateverTheBedsSize) {
  using enum SurfaceKind;
  constexpr std::pair<int, int> sizes[] = {{1, 1}, {1, 300}, {50, 30}, {64, 128}, {129, 127}, {400, 333}};
  for (const auto kind : {flat, cylinder, cone, cliff, noise, ripples})
    for (const auto& [rows, cols] : sizes) {
      HeightField bed = make_surface(surface_of(kind), rows, cols, 0.002);
      ASSERT_EQ(bed.allocated_tiles(), 0);
      EXPECT_TRUE((written(bed) == bed.grid()).all())
          << static_cast<int>(kind) << ": " << rows << " x " << cols;
      EXPECT_EQ(bed.allocated_tiles(), 0);
      bed.set(rows - 1, cols - 1, -0.25);
      bed.set(rows / 2, cols / 3, 0.125);
      EXPECT_TRUE((written(bed) == bed.grid()).all())
          << static_cast<int>(kind) << ": " << rows << " x " << cols;
    }
}

TEST_F(BedWriter, ABedGivenAsNumbersReadsAsThem) {
  const HeightGrid heights = HeightGrid::Random(150, 200);
  EXPECT_TRUE((written(HeightField(heights, 0.01)) == heights).all());
}

TEST_F(BedWriter, WhatWasWrittenIsVisitedRowByRowAndTheRestReadsAsTheFillValue) {
  HeightField bed(400, 333, 0.01, std::make_shared<LevelRule>(0.5));
  for (const auto& [row, col] : {std::pair{390, 2}, {3, 330}, {3, 4}}) bed.set(row, col, -0.25);
  written(bed);
  const Hdf5Reader file(path_);
  HeightGrid put_together = HeightGrid::Constant(400, 333, file.fill_value("/bed"));
  std::vector<std::pair<Eigen::Index, Eigen::Index>> starts;
  file.visit_written("/bed", [&](Eigen::Index row, Eigen::Index col, const HeightGrid& heights) {
    starts.emplace_back(row, col);
    put_together.block(row, col, heights.rows(), heights.cols()) = heights;
  });
  EXPECT_TRUE((put_together == bed.grid()).all());
  EXPECT_EQ(starts.size(), 3u);
  EXPECT_TRUE(std::is_sorted(starts.begin(), starts.end()));
  const BedGeometry geometry = file.bed_geometry("/bed", 0.01);
  EXPECT_EQ(geometry.rows(), 400);
  EXPECT_EQ(geometry.cols(), 333);
}

TEST_F(BedWriter, TheFileFollowsWhatIsNotLevel) {
  const auto bytes = [&](const HeightField& bed) {
    Hdf5Writer file(path_, any_hdf5);
    write_bed(file, "/bed", bed);
    file.finish();
    return fs::file_size(path_);
  };
  constexpr int side = 1 << 16;
  constexpr std::size_t chunk = 128 * 128 * sizeof(double), rest = 10'000;
  HeightField bed(side, side, 0.002);
  EXPECT_LT(bytes(bed), rest);
  bed.set(side - 1, 0, 0.5);
  EXPECT_LT(bytes(bed), chunk + rest);
  bed.set(side - 65, 1, 0.5);  // in another tile of the same chunk
  EXPECT_LT(bytes(bed), chunk + rest);
  bed.set(5, side / 2, 0.5);
  EXPECT_LT(bytes(bed), 2 * chunk + rest);

  SurfaceSettings plateau = surface_of(SurfaceKind::cylinder);
  plateau.radius = 0.1;  // 50 cells, over the corner of four chunks
  EXPECT_LT(bytes(make_surface(plateau, side, side, 0.002)), 4 * chunk + rest);

  // A cliff's foot and its top are level: what most sand has is not written, be it low or high.
  for (const double height : {0.1, -0.1}) {
    SurfaceSettings cliff = surface_of(SurfaceKind::cliff);
    cliff.height = height;
    EXPECT_LT(bytes(make_surface(cliff, 128, 1024, 0.002)), 5 * chunk + rest);
  }
}

}  // namespace
}  // namespace sandstroke
