#include "sand/height_field.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(HeightField, IsCentredOnTheOrigin) {
  const HeightField odd(5, 3, 0.1), even(4, 4, 0.1);
  EXPECT_EQ(odd.x_of(1), 0.0);
  EXPECT_EQ(odd.y_of(2), 0.0);
  EXPECT_DOUBLE_EQ(even.x_of(0), -0.15);
  EXPECT_DOUBLE_EQ(even.x_of(3), 0.15);
  EXPECT_DOUBLE_EQ(even.col_at(even.x_of(3)), 3.0);
}

TEST(HeightField, KeepsEveryCellInItsTile) {
  HeightGrid heights(70, 130);  // neither side a whole number of tiles
  for (int row = 0; row < 70; ++row)
    for (int col = 0; col < 130; ++col) heights(row, col) = 1000.0 * row + col;
  const HeightField bed(heights, 0.01);
  EXPECT_EQ(bed.tile_rows(), 2);
  EXPECT_EQ(bed.tile_cols(), 3);
  EXPECT_TRUE((bed.grid() == heights).all());
  for (int tile = 0; tile < bed.tile_count(); ++tile) {
    const CellRange cells = bed.tile_cells(tile);
    for (int row = cells.row_begin; row < cells.row_end; ++row)
      for (int col = cells.col_begin; col < cells.col_end; ++col) {
        const int in_tile = (row - cells.row_begin) * HeightField::tile_side + col - cells.col_begin;
        EXPECT_EQ(bed.tile_data(tile)[in_tile], heights(row, col));
      }
  }
}

TEST(HeightField, OnlyTheTileOfAChangedCellChangesRevision) {
  HeightField bed(130, 130, 0.01);
  std::vector<std::uint64_t> before;
  for (int tile = 0; tile < bed.tile_count(); ++tile) before.push_back(bed.tile_revision(tile));
  bed.set(64, 63, 1.0);  // second row of tiles, first column
  for (int tile = 0; tile < bed.tile_count(); ++tile)
    EXPECT_EQ(bed.tile_revision(tile) != before[tile], tile == bed.tile_index(1, 0)) << tile;
}

TEST(HeightField, VolumeIsHeightTimesArea) {
  const HeightField bed(HeightGrid::Constant(300, 200, 0.25), 0.01);
  EXPECT_NEAR(bed.volume(), 300 * 200 * 0.25 * 1e-4, 1e-15);
}

}  // namespace
}  // namespace sandstroke
