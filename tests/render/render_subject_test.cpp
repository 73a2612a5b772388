#include "render/render_subject.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(RenderSubject, FramesTheFocusWithAMarginInsideTheBed) {
  const CellRange range = framed_cells({50, 60, 2, 42}, 100, 200, 0.01, 0.03);
  EXPECT_EQ(range.row_begin, 46);  // a tenth of 40 cells is more than 3 cm
  EXPECT_EQ(range.row_end, 64);
  EXPECT_EQ(range.col_begin, 0);
  EXPECT_EQ(range.col_end, 46);
  EXPECT_EQ(framed_cells({50, 51, 50, 51}, 100, 200, 0.01, 0.03).row_begin, 47);
}

TEST(RenderSubject, FramesTheBedWithoutAFocus) {
  const CellRange range = framed_cells({}, 100, 200, 0.01, 0.03);
  EXPECT_EQ(range.row_end, 100);
  EXPECT_EQ(range.col_end, 200);
}

TEST(RenderSubject, RangesHoldTheValuesAndAreNeverEmpty) {
  EXPECT_EQ(value_range(-1.0, 3.0, false).low, -1.0);
  EXPECT_EQ(value_range(-1.0, 3.0, true).low, -3.0);
  EXPECT_EQ(value_range(-1.0, 3.0, true).high, 3.0);
  EXPECT_LT(value_range(0.2, 0.2, false).low, 0.2);
  EXPECT_GT(value_range(0.2, 0.2, false).high, 0.2);
  EXPECT_GT(value_range(0.0, 0.0, true).high, 0.0);
}

}  // namespace
}  // namespace sandstroke
