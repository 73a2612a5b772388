#include "sand/block_ranges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sandstroke {
namespace {

constexpr double slope = 0.65, cell = 0.002, side = BlockRanges::block * cell;  // rise over run; m

HeightField rough(unsigned seed, int rows, int cols) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.0, 0.02);
  HeightGrid heights(rows, cols);
  for (double& height : heights.reshaped()) height = any(random);
  for (int spike = 0; spike < 3; ++spike)
    heights(static_cast<int>(random() % rows), static_cast<int>(random() % cols)) = 0.2;
  return HeightField(heights, cell);
}
std::vector<BlockRanges> ranges_of(const HeightField& bed) {
  std::vector<BlockRanges> ranges(bed.tile_count());
  for (int tile = 0; tile < bed.tile_count(); ++tile) ranges[tile].know(bed, tile);
  return ranges;
}
/// The level of a cell's funnel, cell by cell.
double funnel(const HeightGrid& heights, int row, int col) {
  double level = heights(row, col);
  for (int r = 0; r < heights.rows(); ++r)
    for (int c = 0; c < heights.cols(); ++c)
      level = std::max(level, heights(r, c) - slope * cell * std::hypot(r - row, c - col));
  return level;
}

TEST(BlockRanges, HoldTheirCellsAndFollowChanges) {
  HeightField bed = rough(1, 100, 70);
  std::vector<BlockRanges> ranges = ranges_of(bed);
  EXPECT_EQ(ranges[0].whole.low, bed.grid().block(0, 0, 64, 64).minCoeff());
  EXPECT_EQ(ranges[3].of(0).high, bed.grid().block(64, 64, 8, 6).maxCoeff());
  EXPECT_LT(ranges[3].of(63).high, ranges[3].of(63).low);  // beyond the bed
  bed.set(70, 66, -1.0);
  for (int tile = 0; tile < bed.tile_count(); ++tile) ranges[tile].know(bed, tile);
  EXPECT_EQ(ranges[3].whole.low, -1.0);
  EXPECT_EQ(ranges[3].of(0).low, -1.0);
  const HeightField level(200, 200, cell);
  EXPECT_TRUE(ranges_of(level)[5].blocks.empty());
}

TEST(Funnels, AreNeverTooLowAndByLittleTooHigh) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const HeightField bed = rough(seed, 90, 140);
    const HeightGrid heights = bed.grid();
    const Funnels funnels(bed, ranges_of(bed), {0, bed.tile_rows(), 0, bed.tile_cols()}, slope);
    for (int row = 0; row < bed.rows(); row += 3)
      for (int col = 0; col < bed.cols(); col += 3) {
        const double bound = funnels.level(row / BlockRanges::block, col / BlockRanges::block),
                     exact = funnel(heights, row, col);
        EXPECT_GE(bound, exact) << row << " " << col;
        // The way is counted along the longer axis, from block to block, without the two ends.
        const double far = std::max((0.2 - exact) / slope, 0.0);
        EXPECT_LE(bound, exact + slope * (2.0 * std::sqrt(2.0) * side + (1.0 - std::sqrt(0.5)) * far) + 1e-12)
            << row << " " << col;
      }
  }
}

TEST(Funnels, TellTheBlocksThatHaveLowCells) {
  HeightField bed(128, 128, cell);
  bed.set(40, 40, 0.1);
  const std::vector<BlockRanges> ranges = ranges_of(bed);
  const Funnels funnels(bed, ranges, {0, 2, 0, 2}, slope);
  const auto [blocks, most] = funnels.below(bed, 0, ranges[0], 0.09);
  EXPECT_EQ(most, 0.1);
  EXPECT_EQ(blocks >> (5 * 8 + 5) & 1, 1u);
  EXPECT_EQ(blocks & 1, 0u);
  EXPECT_EQ(funnels.below(bed, 3, ranges[3], 0.09).blocks, 0u);
}

}  // namespace
}  // namespace sandstroke
