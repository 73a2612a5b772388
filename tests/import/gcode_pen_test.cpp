#include "import/gcode_pen.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "gcode_tables.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

SampleTable drawn(const std::string& text, const std::string& up, const std::string& down = "") {
  return parse_gcode(text, "path.gcode", up, down);
}

/// Up to x = 10, then a line from 10 to 40 at y = 10, and one from (40, 40) to (10, 40).
constexpr const char* servo =
    "G21\nG90\n{0}\nG1 X10 Y10 F2000\n{1}\nG1 X40 Y10\n{0}\nG1 X40 Y40\n{1}\nG1 X10 Y40\n{0}\n";

TEST(GcodePen, AServoOfAnyWordIsLiftedByTheOneThatIsNamed) {
  const struct {
    const char *up, *down, *pen_up, *pen_down;
  } pens[] = {
      {"M3 S30", "M3 S90", "M3 S30", ""},
      {"M3 S30", "M3 S90", "", "M3 S90"},
      {"M3 S30", "S90", "M3 S30", ""},
      {"M3 S30", "M3 S90", "M3 S30", "M3 S90"},
      {"M03 S30.0", "M3 S90", "M3 S30", ""},
      {"M5", "M3 S90", "M5", ""},
      {"M4", "M3", "M4", ""},
      {"M280 P0 S30", "M280 P0 S90", "M280 S30", ""},
      {"M280 P0 S30", "M280 P0 S90", "", "M280 S90"},
      {"M107", "M106 S255", "M107", "M106"},
      {"M42 P4 S0", "M42 P4 S255", "m42 s0", ""},
      {"M400\nM300 S50", "M300 S30", "M300 S50", ""},
      {"S30 M3", "S90 M3", "M3 S30", ""},
      {"S30", "S90", "M3 S30", ""},
      {"S30", "S90", "", "M3 S90"},
      {"M107", "M106 S255", "M107", ""},
      {"M106 S0", "M106 S255", "M106 S0", ""},
      {"M106 S0\nM107", "M106 S255", "M106 S0", ""},
      {"M106 S0\nM107", "M106 S255", "M107", ""},
      {"M42 P4 S0\nM42 P5 S1", "M42 P4 S255\nM42 P5 S0", "M42 P4 S0", ""},
      {"M65 P0", "M64 P0", "M65 P0", ""},
      {"M10", "M11", "M10", ""},
      {"M9", "M8", "M9", ""},
      {"M101", "M103", "M101", ""},
  };
  for (const auto& pen : pens) {
    const SampleTable table =
        drawn(fmt::format(fmt::runtime(servo), pen.up, pen.down), pen.pen_up, pen.pen_down);
    EXPECT_THAT(gcode_values(table, "x"), ElementsAre(10, 40, 40, 10)) << pen.up << " / " << pen.pen_up;
    EXPECT_THAT(gcode_values(table, "y"), ElementsAre(10, 10, 40, 40)) << pen.up;
    EXPECT_THAT(table.lifts, ElementsAre(false, true, false, false)) << pen.up;
    EXPECT_THAT(table.warnings, ElementsAre()) << pen.up;
  }
}

TEST(GcodePen, AsksWhichOfTwoPositionsLifts) {
  for (const char* m : {"M3", "M4"}) {
    const std::string path =
        fmt::format(fmt::runtime(servo), fmt::format("{} S30", m), fmt::format("{} S90", m));
    const std::string asked = gcode_complaint(path);
    EXPECT_THAT(asked, AllOf(HasSubstr("path.gcode:3: "), HasSubstr("S 30 and 90"),
                             HasSubstr("stroke.table.pen_up (stroke convert: --pen-up)")));
    // Both ways out that it names work.
    const std::string lifts = fmt::format("{} S30", m);
    EXPECT_THAT(asked, AllOf(HasSubstr("\"" + lifts + "\""), HasSubstr("or to none")));
    EXPECT_EQ(drawn(path, lifts).size(), 4u);
    EXPECT_EQ(path_length(drawn(path, "none")), 90.0);
  }
}

TEST(GcodePen, AsksWhichStateOfAnOutputLifts) {
  const struct {
    const char *up, *down;
  } outputs[] = {{"M107", "M106 S255"},
                 {"M106 S0", "M106 S255"},
                 {"M42 P4 S0", "M42 P4 S255"},
                 {"M65 P0", "M64 P0"},
                 {"M340 P0 S1500", "M340 P0 S2000"},
                 {"M10", "M11"},
                 {"M67 E0 Q0", "M67 E0 Q5"},
                 {"M63 P1", "M62 P1"}};
  for (const auto& [up, down] : outputs) {
    const std::string path = fmt::format(fmt::runtime(servo), up, down);
    EXPECT_THAT(gcode_complaint(path),
                AllOf(HasSubstr("path.gcode:3: "), HasSubstr(up), HasSubstr(down), HasSubstr("--pen-up"),
                      HasSubstr(fmt::format("such as \"{}\"", up))));
    EXPECT_EQ(drawn(path, up).size(), 4u) << up;
    EXPECT_EQ(path_length(drawn(path, "none")), 90.0) << up;
  }
  // A height that is only set, before or behind the path, lifts nothing; nor does a servo that stands still.
  const std::string fan = fmt::format(fmt::runtime(servo), "M107", "M106 S255");
  for (const std::string& path : {fan + "G0 Z5\n", "M280 P0 S90\n" + fan, "G1 X0 Y0\nG1 Z3\n" + fan})
    EXPECT_THAT(gcode_complaint(path), HasSubstr("after M107 and after M106 S255")) << path;
  EXPECT_THAT(gcode_complaint(fmt::format(fmt::runtime(servo), "S30", "S90")),
              AllOf(HasSubstr("after M3 S30 and after M3 S90"), HasSubstr("\"M3 S30\"")));
}

TEST(GcodePen, OutputsThatSurelyLiftNothingAreNotAskedFor) {
  const char* known[] = {
      "M106 S255\nG1 X1 Y0\nX2\nX3\nM107\n",
      "M106 S50\nG1 X1 Y0 E1\nX2 E2\nM106 S255\nX3 E3\nM107\nX4 E4\n",   // a print's fan
      "M107\nG0 Z5\nG0 X0 Y0\nG1 Z-1\nX1\nM106\nX2\nM107\nX3\nG0 Z5\n",  // Z lifts
      "M107\nM3\nG1 X0 Y0\nX1\nM5\nM106\nG0 X2\nM107\nM3\nX3\n",
      "M204 S500\nG1 X1 Y0\nX2\nM204 S900\nX3\nM220 S50\nX4\nM220 S90\nX5\n",
      "G1 X1 Y0\nX2\nG4 S1\nX3\nG4 S2\nX4\n",
      "M8\nG1 X1 Y0\nX2\nM9\nX3\n",
  };
  for (const char* path : known) {
    EXPECT_EQ(gcode_complaint(path), "") << path;
    EXPECT_THAT(gcode_table(path).warnings, ElementsAre()) << path;
  }
}

TEST(GcodePen, CoolantThatAlternatesIsSaidToDraw) {
  const SampleTable table = gcode_table(fmt::format(fmt::runtime(servo), "M9", "M8"));
  EXPECT_THAT(table.warnings, ElementsAre(AllOf(HasSubstr("M9 and M8"), HasSubstr("--pen-up"))));
  EXPECT_EQ(path_length(table), 90.0);
}

TEST(GcodePen, AsksNothingWhereThePathTells) {
  const char* known[] = {
      "M3 S300\nG1 X1 Y0\nX2\nM5\nG1 X5\nM3 S500\nX6\nM5\n",              // M5 lifts
      "M3 S300\nG1 X1 Y0\nX2\nM3 S0\nG1 X5\nM3 S500\nX6\n",               // so does S0
      "M4 S0\nG1 X1 Y0\nX2 S300\nX5 S500\nX6 S20\n",                      // shades of a laser
      "M3 S8000\nG0 Z5\nG0 X0 Y0\nG1 Z-1\nX1\nG0 Z5\nM3 S9000\nX3\n",     // Z lifts
      "M3 S30\nG0 X1 Y0\nM3 S90\nG1 X2\nM3 S30\nG0 X5\nM3 S90\nG1 X6\n",  // G0 travels
      "M3 S30\nG1 X1 Y0\nX2\n",
  };
  for (const char* path : known) EXPECT_EQ(gcode_complaint(path), "") << path;
  EXPECT_THAT(gcode_values(gcode_table(known[4]), "x"), ElementsAre(1, 2, 5, 6));
}

TEST(GcodePen, G0DrawsWithAServoThatIsDown) {
  const std::string path = "M280 S90\nG0 X0 Y0\nM280 S30\nG0 X5\nM280 S90\nG0 X9\n";
  const SampleTable table = drawn(path, "M280 S90");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(0, 5));
  EXPECT_THAT(table.description, HasSubstr("G0 draws too where the pen is down"));
}

TEST(GcodePen, G0MayBeTheWordThatLifts) {
  const std::string path = "G0 X0 Y0\nG1 X5\nG0 Y5\nG1 X0\n";
  const SampleTable table = drawn(path, "G0");
  EXPECT_THAT(gcode_values(table, "y"), ElementsAre(0, 0, 5, 5));
  EXPECT_THAT(table.lifts, ElementsAre(false, true, false, false));
  EXPECT_THAT(table.description, HasSubstr("G0 moves the pen"));
  for (const char* up : {"", "G0", "g00"}) EXPECT_EQ(drawn(path, up, "G1").lifts, table.lifts) << up;
}

TEST(GcodePen, SaysWhatIsWrong) {
  const std::string path = fmt::format(fmt::runtime(servo), "M3 S30", "M3 S90");
  const auto complaint = [&](const std::string& up, const std::string& down) {
    return complaint_of([&] { drawn(path, up, down); });
  };
  for (const char* word : {"S90", "G1", "M3 S30, M5", "M117 up", "up", "M3 M5", "G0 Z5"})
    EXPECT_THAT(complaint(word, ""), HasSubstr("pen_up")) << word;
  EXPECT_THAT(complaint("M3 S30", "M3 S30"), HasSubstr("are the same word"));
  EXPECT_THAT(complaint("", "G0"), HasSubstr("G0 never draws"));
  EXPECT_THAT(complaint("M5", "G1"), HasSubstr("two ways to move a pen"));
  EXPECT_THAT(complaint("", "M106"), HasSubstr("no line has M106, so the pen is never down"));
  EXPECT_THAT(complaint("M3", ""),
              AllOf(HasSubstr("pen_up = \"M3\" lifts it all the time"), HasSubstr("--pen-down")));
  EXPECT_THAT(drawn(path, "M3 S45").warnings,
              ElementsAre(HasSubstr("no line has M3 S45, so the pen never lifts")));
}

}  // namespace
}  // namespace sandstroke
