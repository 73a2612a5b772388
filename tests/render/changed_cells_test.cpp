#include "render/changed_cells.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace sandstroke {
namespace {

TEST(ChangedCells, IsTheSmallestRectangleThatHoldsThem) {
  HeightGrid before = HeightGrid::Zero(20, 30), after = before;
  after(4, 25) = 0.01;
  after(11, 7) = -0.01;
  const CellRange range = changed_cells(before, after, 0.005);
  EXPECT_EQ(range.row_begin, 4);
  EXPECT_EQ(range.row_end, 12);
  EXPECT_EQ(range.col_begin, 7);
  EXPECT_EQ(range.col_end, 26);
}

TEST(ChangedCells, SmallerChangesDoNotCount) {
  HeightGrid before = HeightGrid::Zero(20, 30), after = before;
  after(4, 25) = 0.005;
  EXPECT_TRUE(changed_cells(before, after, 0.005).empty());
}

TEST(ChangedCells, RefusesDifferentShapes) {
  try {
    changed_cells(HeightGrid::Zero(2, 3), HeightGrid::Zero(3, 2), 0.0);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("2 x 3"), std::string::npos);
  }
}

}  // namespace
}  // namespace sandstroke
