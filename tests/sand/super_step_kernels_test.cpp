#include "sand/super_step_kernels.h"

#include <gtest/gtest.h>

#include <memory>

namespace sandstroke {
namespace {

TEST(SuperStage, MovesWithMomentumAndCanBeTakenBack) {
  const auto flow = std::make_unique<TileFlow>();
  const auto tile = std::make_unique<SuperStepTile>();
  const auto patch = std::make_unique<TilePatch>();
  for (int row = 0; row < TilePatch::side; ++row) std::fill_n(patch->heights(row), TilePatch::side, 1.0);
  CellFlags active{}, changed{};
  active[5] = 0xff00;
  flow->rows = {5, 6};
  flow->moved[5] = 0x0300;
  flow->gain[5 * TilePatch::side + 8] = 0.5;
  flow->gain[5 * TilePatch::side + 9] = -0.5;

  HeightRange range = super_stage(*flow, active, 0.0, 0.25, *patch, *tile, changed);
  EXPECT_EQ(patch->heights(5)[8], 1.125);
  EXPECT_EQ(patch->heights(5)[9], 0.875);
  EXPECT_EQ(changed[5], 0x0300u);
  EXPECT_EQ(range.low, 0.875);
  EXPECT_EQ(range.high, 1.125);

  flow->rows = {5, 7};
  active[6] = 0xff;  // joins: it has no momentum, whatever was kept of it
  tile->before.fill(-7.0);
  tile->before[5 * TilePatch::side + 8] = tile->before[5 * TilePatch::side + 9] = 1.0;
  for (int c = 10; c < 16; ++c) tile->before[5 * TilePatch::side + c] = 1.0;
  range = super_stage(*flow, active, 0.5, 0.0, *patch, *tile, changed);
  EXPECT_EQ(patch->heights(5)[8], 1.1875);
  EXPECT_EQ(patch->heights(5)[9], 0.8125);
  EXPECT_EQ(patch->heights(6)[0], 1.0);
  EXPECT_EQ(changed[5], 0x0300u);
  EXPECT_EQ(changed[6], 0u);
  EXPECT_EQ(range.low, 0.8125);

  take_back_stage(*tile, *patch);
  EXPECT_EQ(patch->heights(5)[8], 1.125);
  EXPECT_EQ(patch->heights(5)[9], 0.875);
  EXPECT_EQ(patch->heights(6)[0], 1.0);
  EXPECT_EQ(patch->heights(7)[0], 1.0);
}

TEST(SuperStage, DoesNotTakeAWallForAChange) {
  const auto flow = std::make_unique<TileFlow>();
  const auto tile = std::make_unique<SuperStepTile>();
  const auto patch = std::make_unique<TilePatch>();  // all wall
  patch->heights(0)[1] = 2.0;
  CellFlags active{}, changed{};
  flow->rows = {0, 1};
  active[0] = 0b10;
  const HeightRange range = super_stage(*flow, active, 0.0, 0.25, *patch, *tile, changed);
  EXPECT_EQ(changed[0], 0u);
  EXPECT_EQ(range.low, 2.0);
  EXPECT_EQ(range.high, 2.0);
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
