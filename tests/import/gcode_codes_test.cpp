// Words that do not draw: those of machines, printers and CAM programs.
#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <set>

#include "gcode_tables.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(GcodeCodes, CoordinatesBehindAPrintersMWordMoveNothing) {
  const SampleTable plain = gcode_table("G1 X50 Y50 F3000\nG2 X70 Y50 I10\nG2 X50 Y50 I-10\nG1 X40\n");
  for (const char* word : {"M201 X500 Y500", "M205 X8 Y8", "M73 Q10 R10", "M92 X80 Y80 Z400",
                           "M203 X300 Y300 F900", "M204 P1 X5", "M906 X800 Y800", "M84 X Y Z", "M17 X",
                           "m566 x900.00 y900.00 z6.00", "M220 S50 X3", "M425 X0.1 F1"}) {
    const SampleTable table = gcode_table(fmt::format(
        "{0}\nG21\nG90\nG1 X50 Y50 F3000\nG2 X70 Y50 I10 J0\n{0}\nG2 X50 Y50 I-10 J0\n{0}\nG1 X40\n{0}\n",
        word));
    for (const char* name : {"x", "y", "time"})
      EXPECT_EQ(gcode_values(table, name), gcode_values(plain, name)) << word;
    EXPECT_EQ(table.columns.size(), 3u) << word;
  }
  EXPECT_THAT(gcode_table("M201 X500\nG1 X1 Y1\n").description, HasSubstr("M201 skipped"));
}

TEST(GcodeCodes, SpindleWordsLeaveTheirLineItsMotion) {
  EXPECT_THAT(
      gcode_values(gcode_table("G1 X0 Y0\nM3 S1000 G1 X10\nM8 X20\nX30 M62 P1\nM106 S5 G1 X40\n"), "x"),
      ElementsAre(0, 10, 20, 30, 40));
  EXPECT_THAT(gcode_values(gcode_table("M3 S9\nG1 X1 Y0\nX2 M9\nX3 M5\nX4\n"), "x"), ElementsAre(1, 2))
      << "M5 is in force in its line, as in RS-274";
}

TEST(GcodeCodes, WordsThatKeepThePathArePassedOver) {
  for (const char* word : {"G98",
                           "G99",
                           "G69",
                           "G97",
                           "G96 S90",
                           "G54",
                           "G59",
                           "G59.1",
                           "G15",
                           "G40",
                           "G49",
                           "G50",
                           "G50 S2000",
                           "G61",
                           "G61.1",
                           "G64 P0.01",
                           "G80",
                           "G94",
                           "G43 H1",
                           "G43 H1 Z5",
                           "G44 H2",
                           "G8 P1",
                           "G5.1 Q1",
                           "G10",
                           "G10 P1 S200",
                           "G52 X0 Y0 Z0",
                           "G10 L2 P1 X0 Y0",
                           "G10 L20 P1 X0 Y0",
                           "G5 P10000",
                           "G33",
                           "G17",
                           "G67",
                           "G50.1",
                           "G53",
                           "G187 P1",
                           "T2 M6",
                           "G0 G17 G21 G40 G49 G80 G90 G98"}) {
    const SampleTable table = gcode_table(fmt::format("{}\nG1 X1 Y2\nX3\n", word));
    EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 3)) << word;
    EXPECT_THAT(table.warnings, ElementsAre()) << word;
  }
}

TEST(GcodeCodes, WordsThatChangeThePathAreRefusedEachWithItsReason) {
  const struct {
    const char *line, *why;
  } words[] = {{"G41 D1", "moves the path by the tool's radius"},
               {"G42.1 D3 X5", "moves the path by the tool's radius"},
               {"G81 X5 R2 Z-3", "is a cycle of several moves"},
               {"G73 X5", "is a cycle"},
               {"G51 X0 Y0 P2", "scales or mirrors"},
               {"G68 X0 Y0 R45", "turns the path"},
               {"G16", "polar"},
               {"G10 L2 P1 X5", "offsets"},
               {"G52 X5", "offsets"},
               {"G50 X9", "offsets"},
               {"G10 L20 P1 X0 Y0", "offsets"},
               {"G10 L2 P1 Z0", "offsets"},
               {"G50 X0 Y0", "offsets"},
               {"G5 X1 Y1 I1", "curve of another kind"},
               {"G5 I0 J30 P0 Q30 X0 Y0", "curve of another kind"},
               {"G5 X0 Y0", "curve of another kind"},
               {"G5.1 X0 Y0 I3", "curve of another kind"},
               {"G33 Z-5 K1", "cuts a thread"},
               {"G33 X0 Y0", "cuts a thread"},
               {"G93", "makes F a time"},
               {"G95", "makes F a way per turn"},
               {"G12 I3", ""},
               {"G1.5 X3", ""},
               {"G20.5", ""},
               {"G54.1 P2", ""}};
  for (const auto& word : words)
    EXPECT_THAT(gcode_complaint(fmt::format("G1 X1 Y1\n{}\nX5\n", word.line)),
                AllOf(HasSubstr("path.gcode:2: G"), HasSubstr("is not supported"), HasSubstr(word.why),
                      HasSubstr("with G0 to G3")))
        << word.line;
}

TEST(GcodeCodes, OtherCoordinatesWithinAPathAreRefused) {
  EXPECT_THAT(gcode_complaint("G55\nG1 X1 Y1\nG56\nX2\n"),
              AllOf(HasSubstr("path.gcode:3: G56"), HasSubstr("split")));
  EXPECT_EQ(gcode_complaint("G54\nG55\nG1 X1 Y1\nG55 X2\n"), "");
}

TEST(GcodeCodes, NumbersThatNoWordHasAreRefused) {
  for (const char* word : {"G-1", "G-0", "G1.55", "G1000", "G99999999999", "M-3", "M3.14", "G1e", "G"})
    EXPECT_THAT(gcode_complaint(fmt::format("G1 X0 Y0\n{} X5\n", word)), HasSubstr("path.gcode:2: ")) << word;
  EXPECT_THAT(gcode_complaint("G-1 X5 Y5\n"), HasSubstr("G-1 is no G word, whose number is 0 to 999"));
  EXPECT_THAT(gcode_complaint("G1 X5 Y5 X6\n"), HasSubstr("X is given twice, as 5 and 6"));
  EXPECT_THAT(gcode_values(gcode_table("G01 X1 Y1\nG00X2\nG1.0 X3\n"), "x"), ElementsAre(1, 2, 3));
}

TEST(GcodeCodes, HomeBeforeThePathIsPassedOver) {
  for (const char* home : {"G28", "G28 X Y", "G28 X0 Y0", "G28 Z", "G91 G28 Z0\nG90", "G28 W", "G53 G0 Z0",
                           "G30", "G28 G91 Z0\nG90", "g28 x y", "G29", "G28.1"}) {
    const SampleTable table = gcode_table(fmt::format("G21\n{}\nG1 X10 Y10 F600\nG1 X20 Y10\n", home));
    EXPECT_THAT(gcode_values(table, "x"), ElementsAre(10, 20)) << home;
    EXPECT_THAT(gcode_values(table, "y"), ElementsAre(10, 10)) << home;
    EXPECT_THAT(table.warnings, ElementsAre()) << home;
  }
}

/// Nobody knows where home is: the tool lifts, and goes on where the next move ends.
TEST(GcodeCodes, NothingIsDrawnOnTheWayHomeAndBack) {
  const SampleTable table = gcode_table("G1 X1 Y1\nX2\nG28 X Y\nG1 X8 Y8\nX9\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 2, 8, 9));
  EXPECT_THAT(table.lifts, ElementsAre(false, true, false, false));
  EXPECT_THAT(table.description, HasSubstr("nothing is drawn on the way home (1 times, first in line 3)"));
  EXPECT_THAT(gcode_table("G1 X1 Y1 F60\nX2\nG28\nG1 X2 Y1\nX3\n").lifts, ElementsAre(false, false, false))
      << "it comes back to the same place";
}

TEST(GcodeCodes, AHeightFromHomeIsNotKnown) {
  // With z at 0 and the pen down at -1, or at 0 and up at 5: the way from home is not drawn.
  for (const auto& [down, up] : {std::pair{-1, 3}, std::pair{0, 5}}) {
    const SampleTable table = gcode_table(fmt::format(
        "G0 Z{1}\nG0 X0 Y0\nG1 Z{0}\nX1\nG91 G28 Z0\nG90\nG0 X5 Y5\nG43 Z{1}\nG1 Z{0}\nX6\n", down, up));
    EXPECT_THAT(gcode_values(table, "x"), ElementsAre(0, 1, 5, 6)) << down;
    EXPECT_THAT(table.lifts, ElementsAre(false, true, false, false)) << down;
    EXPECT_THAT(gcode_values(table, "z"), testing::Each(down));
  }
}

/// Home counts as 0, but a Z0 behind it is a move down all the same.
TEST(GcodeCodes, AZOf0BehindHomeLowersThePen) {
  for (const char* home : {"G53 G0 Z0", "G28 Z", "G91 G28 Z0\nG90"}) {
    const SampleTable table = gcode_table(
        fmt::format("G21 G90\nG0 Z5\nG1 X10 Y10 F600\nG1 Z0\nG1 X20 Y10\n{}\nG0 X30 Y10\nG1 Z0\nG1 X40 "
                    "Y10\nG0 Z5\n",
                    home));
    EXPECT_THAT(gcode_values(table, "x"), ElementsAre(10, 20, 30, 40)) << home;
    EXPECT_THAT(table.lifts, ElementsAre(false, true, false, true)) << home;
    const std::vector<double> time = gcode_values(table, "time");
    EXPECT_THAT(std::set<double>(time.begin(), time.end()), testing::SizeIs(4)) << home;
  }
}

TEST(GcodeCodes, RelativeMovesFromHomeTakeTime) {
  const SampleTable table = gcode_table("G1 X1 Y1 F60\nX5\nG28\nG91\nG1 X5\nG1 X5\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 5, 0, 5, 10));
  const std::vector<double> time = gcode_values(table, "time");
  EXPECT_GT(time[2], time[1]);
  EXPECT_EQ(gcode_values(gcode_table("G1 X3 Y0 F60\nX0\nG28\nG91\nG1 X5\n"), "time").size(), 3u)
      << "home is where the path ended";
}

TEST(GcodeCodes, APreambleOfACamProgram) {
  const SampleTable table =
      gcode_table("G0 G17 G21 G40 G49 G80 G90 G98\nG53 G0 Z0\nG0 X10 Y10\nG1 Z-1 F100\nG1 X20\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(10, 20));
  EXPECT_THAT(gcode_values(table, "z"), ElementsAre(-1, -1));
}

TEST(GcodeCodes, RotaryAxesAreSaidToBeLeftOut) {
  EXPECT_THAT(gcode_table("G1 X1 Y1\nX2 A90\nG1 X3 C5\n").warnings,
              ElementsAre(AllOf(HasSubstr("A, B, C, U, V or W"), HasSubstr("2 lines, the first is line 2"))));
}

}  // namespace
}  // namespace sandstroke
