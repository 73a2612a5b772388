#include "import/unipen.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "complaint.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

SampleTable unipen_table(const std::string& text) { return parse_unipen(text, "pen.unp"); }

TEST(Unipen, PenStrokesAreKeptApart) {
  const SampleTable table = unipen_table(
      ".VERSION 1.0\n.COMMENT rows of text\n 1 2\n.COORD X Y\n.SEGMENT WORD 0-1 OK \"and\"\n"
      ".PEN_DOWN\n707 2417\n 707\t2424\n.PEN_UP\n.PEN_DOWN\n+590 -2319.5\n.PEN_UP\n");
  EXPECT_THAT(column(table, "x").values, ElementsAre(707, 707, 590));
  EXPECT_THAT(column(table, "y").values, ElementsAre(2417, 2424, -2319.5));
  EXPECT_EQ(column(table, "x").unit, "");
  EXPECT_THAT(table.lifts, ElementsAre(false, true, true));
  EXPECT_THAT(table.lines, ElementsAre(7u, 8u, 11u));
  EXPECT_EQ(table.columns.size(), 2u);
  EXPECT_THAT(table.description, HasSubstr("2 pen strokes, 3 samples"));
  EXPECT_THAT(table.description, HasSubstr("y is taken to point up"));
}

TEST(Unipen, PointsPerInchGiveMillimetres) {
  const SampleTable inches =
      unipen_table(".X_POINTS_PER_INCH 254\n.Y_POINTS_PER_INCH 508\n.PEN_DOWN\n10 10\n20 40\n");
  EXPECT_THAT(column(inches, "x").values, ElementsAre(1, 2));
  EXPECT_THAT(column(inches, "y").values, ElementsAre(0.5, 2));
  EXPECT_EQ(column(inches, "y").unit, "mm");
  const SampleTable mm = unipen_table(".X_POINTS_PER_MM 100\n.Y_POINTS_PER_MM 100\n.PEN_DOWN\n10 20\n");
  EXPECT_THAT(column(mm, "y").values, ElementsAre(0.2));
  // Nothing can be said of one axis alone.
  EXPECT_EQ(column(unipen_table(".X_POINTS_PER_MM 100\n.PEN_DOWN\n10 20\n"), "x").unit, "");
}

TEST(Unipen, TheRateCountsRowsOfAPenThatIsUp) {
  const SampleTable table = unipen_table(
      ".POINTS_PER_SECOND 100\n.PEN_DOWN\n1 1\n2 2\n.PEN_UP\n3 3\n4 4\n.PEN_DOWN\n5 5\n.DT 500\n.PEN_DOWN\n6 "
      "6\n");
  EXPECT_THAT(column(table, "x").values, ElementsAre(1, 2, 5, 6));
  EXPECT_THAT(column(table, "time").values, ElementsAre(0, 0.01, 0.04, 0.55));
  EXPECT_EQ(column(table, "time").unit, "s");
  EXPECT_THAT(table.lifts, ElementsAre(false, true, true, false));
}

TEST(Unipen, ColumnsAreNamedByCoord) {
  const SampleTable table =
      unipen_table(".COORD T X Y P B\n.POINTS_PER_SECOND 100\n.PEN_DOWN\n10 1 2 300 1\n");
  EXPECT_THAT(column(table, "time").values, ElementsAre(10));
  EXPECT_EQ(column(table, "time").unit, "ms");
  EXPECT_THAT(column(table, "pressure").values, ElementsAre(300));
  EXPECT_EQ(table.columns.size(), 5u);
}

TEST(Unipen, SaysWhatIsWrong) {
  const auto complaint = [](const std::string& text) { return complaint_of([&] { unipen_table(text); }); };
  EXPECT_THAT(complaint(".PEN_DOWN\n1 2\n1\n"),
              AllOf(HasSubstr("pen.unp:3"), HasSubstr("1 numbers instead of 2")));
  EXPECT_THAT(complaint(".PEN_DOWN\n1 inf\n"), AllOf(HasSubstr("pen.unp:2"), HasSubstr("'inf'")));
  EXPECT_THAT(complaint(".PEN_UP\n1 2\n"), HasSubstr("no samples"));
  EXPECT_THAT(complaint(".COORD X T\n"), HasSubstr("X and Y"));
  EXPECT_THAT(complaint(".PEN_DOWN\n1 2\n.COORD Y X\n"), HasSubstr("split the file"));
  EXPECT_THAT(complaint(".POINTS_PER_SECOND 0\n"), HasSubstr("above 0"));
  EXPECT_THAT(complaint(".DT\n"), HasSubstr("needs a number"));
}

TEST(Unipen, IsKnownByItsKeywords) {
  EXPECT_TRUE(looks_like_unipen("a comment\n  .PEN_DOWN\n1 2\n"));
  EXPECT_FALSE(looks_like_unipen(".5 .7\n.PEN_DOWNS\n"));
}

}  // namespace
}  // namespace sandstroke
