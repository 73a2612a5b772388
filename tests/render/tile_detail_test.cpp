#include "render/tile_detail.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(TileDetail, PlanesNeedNoDetail) {
  DrawnHeights heights(65, 65);
  for (int row = 0; row < 65; ++row)
    for (int col = 0; col < 65; ++col)
      heights(row, col) = 0.25f * static_cast<float>(row) - 0.5f * static_cast<float>(col);
  const TileDetail detail = tile_detail(heights, {0, 65, 0, 65});
  EXPECT_EQ(detail.lowest, -32.0);
  EXPECT_EQ(detail.highest, 16.0);
  for (const double error : detail.error) EXPECT_EQ(error, 0.0);
  EXPECT_EQ(level_of_detail(detail, 0.01, 1e6), coarsest_level);
}

TEST(TileDetail, ErrorIsThatOfTheCellsLeftOut) {
  DrawnHeights heights = DrawnHeights::Zero(65, 65);
  heights(4, 12) = 0.5f;  // kept by levels 1 and 2, left out by level 3
  const TileDetail detail = tile_detail(heights, {0, 65, 0, 65});
  EXPECT_EQ(detail.error[0], 0.0);
  EXPECT_EQ(detail.error[1], 0.25);  // its neighbours lie on the squares' slopes, half way up
  EXPECT_EQ(detail.error[3], 0.5);
}

TEST(TileDetail, CutTilesEndAtTheirLastCells) {
  DrawnHeights heights = DrawnHeights::Zero(11, 7);
  heights.row(10) = 1.0f;  // the last row is always a row of vertices
  const TileDetail detail = tile_detail(heights, {0, 11, 0, 7});
  EXPECT_FLOAT_EQ(static_cast<float>(detail.error[coarsest_level]), 0.9f);  // row 9 of a slope over 10 rows
}

TEST(TileDetail, TheSteepestIsTheLargestGradient) {
  DrawnHeights heights(65, 65);
  for (int row = 0; row < 65; ++row)
    for (int col = 0; col < 65; ++col)
      heights(row, col) = 0.003f * static_cast<float>(col) - 0.004f * static_cast<float>(row);
  EXPECT_NEAR(tile_detail(heights, {0, 65, 0, 65}).steepest, 0.005, 1e-6);
}

TEST(LevelOfDetail, GetsCoarserWithDistance) {
  TileDetail rough;
  rough.error = {0.0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06};
  EXPECT_EQ(level_of_detail(rough, 0.01, 1000.0), 0);  // cells of 10 pixels
  EXPECT_EQ(level_of_detail(rough, 0.01, 160.0), 0);   // of 1.6 pixels: every second one would be more than 3
  EXPECT_EQ(level_of_detail(rough, 0.01, 140.0), 1);   // of 1.4 pixels: every second one is enough
  EXPECT_EQ(level_of_detail(rough, 0.01, 25.0), 3);
  EXPECT_EQ(level_of_detail(rough, 0.01, 1.0), coarsest_level);
}

TEST(LevelOfDetail, FollowsTheErrorWhereTheSurfaceIsSmooth) {
  TileDetail smooth;
  smooth.error = {0.0, 1e-5, 2e-5, 4e-5, 1e-3, 1e-2, 1e-1};
  EXPECT_EQ(level_of_detail(smooth, 0.01, 1000.0), 3);  // 0.04 pixels at level 3, 1 at level 4
}

}  // namespace
}  // namespace sandstroke
