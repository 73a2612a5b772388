#include "sand/super_step_kernels.h"

#include <gtest/gtest.h>

#include <memory>

namespace sandstroke {
namespace {

TEST(SuperStage, MovesWithMomentumAndCanBeTakenBack) {
  constexpr int side = BedGeometry::tile_side;
  auto flow = std::make_unique<TileFlow>();
  auto tile = std::make_unique<SuperStepTile>();
  tile->stepped = {};
  alignas(64) static std::array<double, BedGeometry::tile_area> heights;
  heights.fill(1.0);
  CellFlags active{}, changed;
  active[5] = 0xff00;
  flow->moved[5] = 0x0300;
  flow->gain[5 * side + 8] = 0.5;
  flow->gain[5 * side + 9] = -0.5;

  HeightRange range = super_stage(*flow, active, 0.0, 0.25, heights.data(), *tile, changed);
  EXPECT_EQ(heights[5 * side + 8], 1.125);
  EXPECT_EQ(heights[5 * side + 9], 0.875);
  EXPECT_EQ(changed[5], 0x0300u);
  EXPECT_EQ(range.low, 0.875);
  EXPECT_EQ(range.high, 1.125);

  active[6] = 0xff;  // joins: it has no momentum, whatever was kept of it
  tile->before.fill(-7.0);
  tile->before[5 * side + 8] = tile->before[5 * side + 9] = 1.0;
  for (int c = 10; c < 16; ++c) tile->before[5 * side + c] = 1.0;
  range = super_stage(*flow, active, 0.5, 0.0, heights.data(), *tile, changed);
  EXPECT_EQ(heights[5 * side + 8], 1.1875);
  EXPECT_EQ(heights[5 * side + 9], 0.8125);
  EXPECT_EQ(heights[6 * side], 1.0);
  EXPECT_EQ(changed[5], 0x0300u);
  EXPECT_EQ(changed[6], 0u);
  EXPECT_EQ(range.low, 0.8125);

  take_back_stage(*tile, heights.data());
  EXPECT_EQ(heights[5 * side + 8], 1.125);
  EXPECT_EQ(heights[5 * side + 9], 0.875);
  EXPECT_EQ(heights[6 * side], 1.0);
  EXPECT_EQ(heights[7 * side], 1.0);
}

TEST(RangeOf, LeavesOutWhatLiesOutsideTheBed) {
  alignas(64) static std::array<double, BedGeometry::tile_area> heights;
  heights.fill(-99.0);
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 13; ++col) heights[row * BedGeometry::tile_side + col] = row + 0.01 * col;
  const HeightRange range = range_of(heights.data(), 3, 13);
  EXPECT_EQ(range.low, 0.0);
  EXPECT_EQ(range.high, 2.12);
}

}  // namespace
}  // namespace sandstroke
