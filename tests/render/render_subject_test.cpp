#include "render/render_subject.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sandstroke {
namespace {

TEST(RenderSubject, FramesTheFocusWithAMarginInsideTheBed) {
  const CellRange range = framed_cells({50, 60, 2, 82}, 100, 200, 0.01, 0.03);
  EXPECT_EQ(range.row_begin, 46);  // a twentieth of 80 cells is more than 3 cm
  EXPECT_EQ(range.row_end, 64);
  EXPECT_EQ(range.col_begin, 0);
  EXPECT_EQ(range.col_end, 86);
  EXPECT_EQ(framed_cells({50, 51, 50, 51}, 100, 200, 0.01, 0.03).row_begin, 47);
}

TEST(RenderSubject, FramesTheBedWithoutAFocus) {
  const CellRange range = framed_cells({}, 100, 200, 0.01, 0.03);
  EXPECT_EQ(range.row_end, 100);
  EXPECT_EQ(range.col_end, 200);
}

TEST(RenderSubject, StartHeightsAreThoseOfTheBedAndOfItsBorder) {
  HeightGrid surface = HeightGrid::Zero(4, 5);
  surface(1, 2) = 0.7;
  surface(2, 2) = -0.3;
  for (const auto& [row, col] : {std::pair{0, 2}, {3, 1}, {2, 0}, {1, 4}}) {
    HeightGrid raised = surface;
    raised(row, col) = 0.2;
    const StartHeights start = start_heights(HeightField(raised, 0.01));
    EXPECT_EQ(start.lowest, -0.3);
    EXPECT_EQ(start.highest, 0.7);
    EXPECT_EQ(start.border, 0.2) << row << " " << col;
  }
}

TEST(RenderSubject, AStrokeCoversTheCellsUnderTheToolWhereItIsBelowTheSand) {
  const BedGeometry bed(100, 200, 0.01);
  const auto tip = [&](int row, int col, double z) {
    return Eigen::Vector3d(bed.x_of(col), bed.y_of(row), z);
  };
  EXPECT_EQ(cells_under({tip(20, 50, -0.01), tip(70, 150, 0.01)}, 0.025, bed, 0.0),
            (CellRange{18, 23, 48, 53}));
  EXPECT_EQ(cells_under({tip(20, 50, -0.01), tip(70, 150, 0.01)}, 0.025, bed, 0.02),
            (CellRange{18, 73, 48, 153}));
  EXPECT_EQ(cells_under({tip(-1, 199, -0.01)}, 0.025, bed, 0.0), (CellRange{0, 2, 197, 200}));
  EXPECT_TRUE(cells_under({tip(20, 50, 0.0)}, 0.025, bed, 0.0).empty());
  EXPECT_TRUE(cells_under({tip(20, 500, -0.01), tip(20, -500, 1.0)}, 0.025, bed, 0.0).empty());
  EXPECT_EQ(
      cells_under({tip(20, 50, -0.01), {std::nan(""), 0.0, -1.0}, {0.0, -HUGE_VAL, -1.0}}, 0.025, bed, 0.0),
      (CellRange{18, 23, 48, 53}));
  EXPECT_EQ(cells_under({{-1e30, -1e30, -1.0}, {1e30, 1e30, -1.0}}, 0.025, bed, 0.0), bed.cells());
}

TEST(RenderSubject, RangesHoldTheValuesAndAreNeverEmpty) {
  EXPECT_EQ(value_range(-1.0, 3.0, ColourScale::sequential).low, -1.0);
  EXPECT_EQ(value_range(-1.0, 3.0, ColourScale::diverging).low, -3.0);
  EXPECT_EQ(value_range(-1.0, 3.0, ColourScale::diverging).high, 3.0);
  EXPECT_LT(value_range(0.2, 0.2, ColourScale::sequential).low, 0.2);
  EXPECT_GT(value_range(0.2, 0.2, ColourScale::sequential).high, 0.2);
  EXPECT_GT(value_range(0.0, 0.0, ColourScale::diverging).high, 0.0);
}

}  // namespace
}  // namespace sandstroke
