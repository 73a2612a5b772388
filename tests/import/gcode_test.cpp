#include "import/gcode.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gcode_tables.h"
#include "import/gcode_words.h"

namespace sandstroke {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;

/// The area in the closed line through the samples: above 0 counterclockwise.
double enclosed_area(const SampleTable& table) {
  const std::vector<double> x = gcode_values(table, "x"), y = gcode_values(table, "y");
  double twice = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t next = (i + 1) % x.size();
    twice += x[i] * y[next] - x[next] * y[i];
  }
  return 0.5 * twice;
}

/// Every sample and every middle between two is that far from the centre.
void expect_on_circle(const SampleTable& table, double x0, double y0, double radius) {
  const std::vector<double> x = gcode_values(table, "x"), y = gcode_values(table, "y");
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(std::hypot(x[i] - x0, y[i] - y0), radius, 1e-9);
    if (i == 0) continue;
    const double middle = std::hypot(0.5 * (x[i] + x[i - 1]) - x0, 0.5 * (y[i] + y[i - 1]) - y0);
    EXPECT_LE(middle, radius);
    EXPECT_GE(middle, radius - gcode_arc_tolerance * (1.0 + 1e-9));
  }
}

TEST(Gcode, LinesAbsoluteAndRelativeInBothUnits) {
  const SampleTable table = gcode_table("G21 G90\nG0 X1 Y2\nG1 X3\nY-4\nG91\nX1 Y1\nG20 X1\nG90 G1 X1 Y0\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 3, 3, 4, 29.4, 25.4));
  EXPECT_THAT(gcode_values(table, "y"), ElementsAre(2, 2, -4, -3, -3, 0));
  EXPECT_EQ(column(table, "x").unit, "mm");
  EXPECT_THAT(table.lines, ElementsAre(2u, 3u, 4u, 6u, 7u, 8u));
  EXPECT_EQ(table.columns.size(), 2u);  // neither z nor time
  EXPECT_THAT(table.lifts, ElementsAre());
}

TEST(Gcode, AWholeCircleInBothDirections) {
  for (const bool clockwise : {false, true}) {
    const SampleTable table = gcode_table(fmt::format("G0 X13 Y4 F600\nG{} I-10\n", clockwise ? 2 : 3));
    expect_on_circle(table, 3.0, 4.0, 10.0);
    EXPECT_NEAR(path_length(table), 2.0 * pi * 10.0, 2e-3 * pi);
    EXPECT_NEAR(enclosed_area(table), (clockwise ? -1.0 : 1.0) * pi * 100.0, 0.2);
    EXPECT_DOUBLE_EQ(gcode_values(table, "x").back(), 13.0);
    EXPECT_NEAR(gcode_values(table, "time").back(), 2.0 * pi, 1e-12);  // 10 mm/s
    EXPECT_LT(table.size(), 200u);
  }
}

TEST(Gcode, ArcsByCentreAndByRadiusAreTheSame) {
  struct {
    const char *by_centre, *by_radius;
    double x0, y0, length;
  } const arcs[] = {
      {"G3 X0 Y10 I-10 J0", "G3 X0 Y10 R10", 0, 0, 5 * pi},
      {"G3 X0 Y10 I0 J10", "G3 X0 Y10 R-10", 10, 10, 15 * pi},
      {"G2 X0 Y10 I0 J10", "G2 X0 Y10 R10", 10, 10, 5 * pi},
      {"G2 X0 Y10 I-10 J0", "G2 X0 Y10 R-10", 0, 0, 15 * pi},
  };
  for (const auto& arc : arcs) {
    const SampleTable one = gcode_table(fmt::format("G1 X10 Y0\n{}\n", arc.by_centre));
    const SampleTable other = gcode_table(fmt::format("G1 X10 Y0\n{}\n", arc.by_radius));
    expect_on_circle(one, arc.x0, arc.y0, 10.0);
    EXPECT_NEAR(path_length(one), arc.length, 1e-2);
    EXPECT_THAT(gcode_values(other, "x"), Pointwise(DoubleNear(1e-9), gcode_values(one, "x")))
        << arc.by_radius;
    EXPECT_THAT(gcode_values(other, "y"), Pointwise(DoubleNear(1e-9), gcode_values(one, "y")))
        << arc.by_radius;
  }
}

TEST(Gcode, CentresMayBeAbsolute) {
  const SampleTable table = gcode_table("G90.1\nG1 X13 Y4\nG2 X3 Y-6 I3 J4\n");
  expect_on_circle(table, 3.0, 4.0, 10.0);
  EXPECT_NEAR(path_length(table), 5 * pi, 1e-2);
}

/// z climbs evenly with the angle, at a speed that is that of the whole way.
TEST(Gcode, AHelixClimbsEvenly) {
  const SampleTable table = gcode_table("G1 X5 Y0 Z0 F60\nG3 X5 Y0 I-5 Z4\nG3 X5 Y0 I-5 Z8\n");
  expect_on_circle(table, 0.0, 0.0, 5.0);
  const std::vector<double> z = gcode_values(table, "z"), time = gcode_values(table, "time");
  EXPECT_NEAR(time.back(), 2.0 * std::hypot(2.0 * pi * 5.0, 4.0), 1e-9);
  for (std::size_t i = 0; i < z.size(); ++i) {
    EXPECT_NEAR(z[i], 8.0 * static_cast<double>(i) / static_cast<double>(z.size() - 1), 1e-12);
    EXPECT_NEAR(time[i] / time.back(), z[i] / 8.0, 1e-12);
  }
  EXPECT_THAT(table.lifts, ElementsAre());
}

TEST(Gcode, LargeArcsAreKeptToAFractionOfTheirRadius) {
  const SampleTable table = gcode_table("G1 X1e0 Y0\nX1000000 Y0\nG3 I-1000000\n");
  EXPECT_LT(table.size(), 1000u);
}

TEST(Gcode, FeedGivesTheTime) {
  // The first move takes no time: where it comes from is not known. G0 is as fast as the speed in force.
  const SampleTable mm = gcode_table("G0 X0 Y0\nX10\nG1 X20 F1200\nG0 Y30\nG1 Y0 F600\n");
  EXPECT_THAT(gcode_values(mm, "time"), ElementsAre(0, 0.5, 1, 2.5, 5.5));
  const SampleTable inch = gcode_table("F60 G20\nG1 X0 Y0\nX1\n");
  EXPECT_THAT(gcode_values(inch, "time"), ElementsAre(0, 1));
  EXPECT_THAT(gcode_values(inch, "x"), ElementsAre(0, 25.4));
}

TEST(Gcode, TheFOfADwellIsATime) {
  EXPECT_THAT(gcode_values(gcode_table("G1 X0 Y0 F60\nX1\nG4 F2\nG04 F0\nX2\n"), "time"),
              ElementsAre(0, 1, 2));
}

TEST(Gcode, MovesThatAreNoneAreLeftOut) {
  const SampleTable table = gcode_table("G1 F60 X1 Y1\nX1\nX1 Y1\nX2\n");
  EXPECT_THAT(gcode_values(table, "time"), ElementsAre(0, 1));
}

TEST(Gcode, WordsAsPeopleWriteThem) {
  const SampleTable table = gcode_table(
      "%\n$H\nN10 g21g90 (in mm) ; and absolute\r\nn20 G 1 x +1.5 y-.5*71\r\nM117 Hello (world\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1.5));
  EXPECT_THAT(gcode_values(table, "y"), ElementsAre(-0.5));
}

TEST(Gcode, MachineWordsArePassedOverAndSaid) {
  const SampleTable table = gcode_table("G28 X0 Y0\nM84 S5\nT1 M6\nG1 X1 Y1\nG4 P2\nG1 X2 E5\nG28\nM2\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 2));
  EXPECT_THAT(table.description, HasSubstr("G4, G28 skipped"));
}

TEST(Gcode, G92MovesTheOrigin) {
  EXPECT_THAT(gcode_values(gcode_table("G1 X10 Y0\nG92 X0\nX5\nG92.1\nX1\n"), "x"), ElementsAre(10, 15, 1));
}

TEST(Gcode, AZThatMovesByItselfLiftsThePen) {
  const SampleTable table =
      gcode_table("G0 Z5\nG0 X1 Y1\nG1 Z-0.5 F60\nX2\nX3\nG0 Z5\nX7 Y7\nG1 Z-0.5\nX8\nG0 Z5\nX0 Y0\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 2, 3, 7, 8));
  EXPECT_THAT(gcode_values(table, "z"), Each(-0.5));
  EXPECT_THAT(table.lifts, ElementsAre(false, false, true, false, true));
  // Time goes on while the pen is up: from 3 to 7 and up and down again.
  EXPECT_NEAR(gcode_values(table, "time")[3] - gcode_values(table, "time")[2],
              5.5 + std::hypot(4.0, 6.0) + 5.5, 1e-12);
}

TEST(Gcode, APenMayDrawAtSeveralDepths) {
  const SampleTable table = gcode_table("G0 X0 Y0 Z5\nG1 Z-1\nX1\nZ-2\nX0\nZ5\nX9\n");
  EXPECT_THAT(gcode_values(table, "z"), ElementsAre(-1, -1, -2, -2));
  EXPECT_THAT(table.lifts, ElementsAre(false, false, false, true));
}

TEST(Gcode, APenMayDrawAboveZero) {
  const SampleTable table = gcode_table("G0 X0 Y0 Z9\nZ1\nX1\nZ9\nX5\nZ1\nX6\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(0, 1, 5, 6));
  EXPECT_THAT(table.lifts, ElementsAre(false, true, false, false));
}

TEST(Gcode, AZThatIsNowhereAboveTheDrawingLiftsNothing) {
  const SampleTable table = gcode_table("G1 X10 Y10\nG0 Z5\nG1 X20 Y10\n");
  EXPECT_THAT(gcode_values(table, "z"), ElementsAre(0, 5, 5));
  EXPECT_THAT(table.lifts, ElementsAre());
  EXPECT_THAT(table.description, AllOf(HasSubstr("Z is a height"), Not(HasSubstr("the pen is up"))));
}

TEST(Gcode, AReliefKeepsItsHeights) {
  const SampleTable table = gcode_table("G1 X0 Y0 Z1\nX1 Z-1\nX2 Z2\n");
  EXPECT_THAT(gcode_values(table, "z"), ElementsAre(1, -1, 2));
  EXPECT_THAT(table.lifts, ElementsAre());
}

TEST(Gcode, M3AndM5MoveThePen) {
  const SampleTable table = gcode_table("G0 X1 Y0\nM3 S90\nG1 X2\nX3\nM5\nG1 X7\nM3\nX8\nM5\nG0 X0\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 2, 3, 7, 8));
  EXPECT_THAT(table.lifts, ElementsAre(false, false, true, false, true));
}

TEST(Gcode, ALaserDrawsWithPowerAndNotInG0) {
  const SampleTable table = gcode_table("M4 S0\nG0 X1 Y0\nG1 X2 S500\nG0 X5\nG1 X6\nG1 X9 S0\nG1 X10 S20\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 2, 5, 6, 9, 10));
  EXPECT_THAT(table.lifts, ElementsAre(false, true, false, true, false, false));
}

TEST(Gcode, APenUpAtZeroIsUpWhereItDrawsBelow) {
  const SampleTable table = gcode_table("G0 X0 Y0 Z0\nG1 Z-2\nX1\nG1 Z0\nX5\nZ-2\nX6\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(0, 1, 5, 6));
  EXPECT_THAT(table.lifts, ElementsAre(false, true, false, false));
}

TEST(Gcode, APenOnAServoIsLiftedByTheWordThatIsNamed) {
  const std::string drawn = "M280 P0 S90\nG1 X1 Y0\nM280 P0 S30\nX2\nX3\nM280 P0 S90\nX7\nM280 P0 S30\nX8\n";
  const SampleTable table = parse_gcode(drawn, "path.gcode", "M280 S90");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 2, 3, 7, 8));
  EXPECT_THAT(table.lifts, ElementsAre(false, false, true, false, false));
  EXPECT_THAT(gcode_complaint(drawn), AllOf(HasSubstr("path.gcode:1: M280 moves a pen to S 30 and 90"),
                                            HasSubstr("stroke.table.pen_up (stroke convert: --pen-up)")));
  EXPECT_THAT(gcode_complaint("M300 S30\nG1 X1 Y0\nM300 S50\nX2\n"), HasSubstr("M300 moves a pen"));
  EXPECT_EQ(gcode_complaint("M300 S440\nG1 X1 Y0\nM300 S880\nX2\n"), "") << "tones";
  EXPECT_THAT(table.description, HasSubstr("M280 S90 moves the pen"));
  EXPECT_THAT(table.warnings, ElementsAre());
  EXPECT_THAT(parse_gcode(drawn, "path.gcode", "M280 S45").warnings,
              ElementsAre(HasSubstr("no line has M280 S45, so the pen never lifts")));
  EXPECT_THAT(complaint_of([&] { parse_gcode(drawn, "path.gcode", "M280"); }),
              HasSubstr("pen_up = \"M280\" lifts it all the time"));
  EXPECT_THAT(complaint_of([&] { parse_gcode(drawn, "path.gcode", "S90"); }), HasSubstr("\"M280 S90\""));
}

TEST(Gcode, OnlyTheSpindlesWordsSetItsPower) {
  const SampleTable table = gcode_table("M3 S9\nG1 X1 Y0\nM106 S0\nX2\nM84 S0\nX3\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 2, 3));
  EXPECT_THAT(table.lifts, ElementsAre(false, false, false));
}

TEST(Gcode, ThatG0DrawsIsSaidWhereNothingLiftsAPen) {
  const std::string path = "G0 X0 Y0\nG1 X9\nG0 Y5\nG1 X0\n";
  EXPECT_THAT(gcode_table(path).description, AllOf(HasSubstr("G0 draws too"), HasSubstr("--pen-up) to G0")));
  EXPECT_THAT(gcode_table("M3\n" + path).description, Not(HasSubstr("G0 draws")));
  EXPECT_THAT(gcode_table("G0 X0 Y0\nG1 X9\n").description, Not(HasSubstr("G0 draws")));
}

TEST(Gcode, MessagesMoveNothing) {
  EXPECT_THAT(gcode_values(gcode_table("G1 X1 Y0\nM117 X5 Y7\nX2\n"), "x"), ElementsAre(1, 2));
}

TEST(Gcode, SaysWhatIsWrong) {
  EXPECT_THAT(gcode_complaint("G1 X0 Y0\nG81 X1\n"),
              AllOf(HasSubstr("path.gcode:2"), HasSubstr("G81 is not supported")));
  EXPECT_THAT(gcode_complaint("G1 X#1\n"), AllOf(HasSubstr("path.gcode:1"), HasSubstr("X#1")));
  EXPECT_THAT(gcode_complaint("G1 Xnan\n"), HasSubstr("not a word"));
  EXPECT_THAT(gcode_complaint("G1 X1 F0\n"), HasSubstr("F0 is not above 0"));
  EXPECT_THAT(gcode_complaint("G1 X9999999999999\n"), HasSubstr("1e+12 mm away"));
  EXPECT_THAT(gcode_complaint("G1 X0 Y0\nG2 X10 I3\n"), HasSubstr("ends 7 mm from it"));
  EXPECT_THAT(gcode_complaint("G1 X0 Y0\nG2 X10 R3\n"), HasSubstr("too small"));
  EXPECT_THAT(gcode_complaint("G1 X0 Y0\nG2 R3 X0\n"), HasSubstr("give I and J"));
  EXPECT_THAT(gcode_complaint("G1 X0 Y0\nG2 X1\n"), HasSubstr("radius is 0 mm"));
  EXPECT_THAT(gcode_complaint("G18 G2 X1 I1\n"), HasSubstr("plane of X and Y"));
  EXPECT_THAT(gcode_complaint("; nothing\n"), HasSubstr("has no moves"));
  EXPECT_THAT(gcode_complaint("M5\nM3 S0\nG1 X1 Y1\nX2\n"), HasSubstr("never down"));
}

TEST(Gcode, IsKnownByItsWords) {
  EXPECT_TRUE(looks_like_gcode("; Sandify\nG0 X1\n"));
  EXPECT_TRUE(looks_like_gcode("%\nO1000\nN1 g21 g90\n"));
  for (const char* table : {"x y\n1 2\n", "g1,g2\n1,2\n", "# G0\n0 1\n", "", "time\tG1\n", "G5 X1\n"})
    EXPECT_FALSE(looks_like_gcode(table)) << table;
}

}  // namespace
}  // namespace sandstroke
