#include "import/gcode_program.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "gcode_tables.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(GcodeProgram, NothingIsDrawnBehindItsEnd) {
  for (const char* end : {"M2", "M02", "M30", "m30 (end)", "M99", "%", "M5 M2", "N90 M30"}) {
    const SampleTable table = gcode_table(fmt::format(
        "%\nO1000 (MAIN)\nG21\nG90\nG1 X10 Y10 F600\nG1 X20 Y10\n{}\nG1 X500 Y500\nany text\nX600\n", end));
    EXPECT_THAT(gcode_values(table, "x"), ElementsAre(10, 20)) << end;
    EXPECT_THAT(table.warnings, ElementsAre(AllOf(HasSubstr("path.gcode:7: "), HasSubstr("ends the program"),
                                                  HasSubstr("2 lines, the first is line 8"))))
        << end;
  }
}

TEST(GcodeProgram, AnEndAtTheEndIsNothingToTell) {
  for (const char* end : {"M2\n", "M30\n%\n", "M30\nM84\n(done)\n", "%"})
    EXPECT_THAT(gcode_table(fmt::format("%\nG1 X1 Y1\nX2\n{}", end)).warnings, ElementsAre()) << end;
  EXPECT_THAT(gcode_values(gcode_table("G1 X1 Y1\nX2 M30\nX3\n"), "x"), ElementsAre(1, 2))
      << "the line's own move is made";
}

TEST(GcodeProgram, M30WithAFileNameDeletesAFile) {
  EXPECT_THAT(gcode_values(gcode_table("M30 old.gco\nG1 X1 Y1\nX2\n"), "x"), ElementsAre(1, 2));
}

TEST(GcodeProgram, CallsAreSaidNotToBeFollowed) {
  const struct {
    const char *call, *word;
  } calls[] = {{"M98 P1", "M98"},
               {"M97 P5", "M97"},
               {"G65 P9010 X5 Y5", "G65"},
               {"o100 call", "O CALL"},
               {"o<square> call [5]", "O CALL"},
               {"O101 while [1 LT 2]", "O WHILE"}};
  for (const auto& call : calls) {
    const SampleTable table =
        gcode_table(fmt::format("G0 X0 Y0\nG1 X1 Y1 F600\n{0}\nG1 X3 Y3\n{0}\n", call.call));
    EXPECT_THAT(gcode_values(table, "x"), ElementsAre(0, 1, 3)) << call.call;
    EXPECT_THAT(table.warnings, ElementsAre(AllOf(HasSubstr(std::string(call.word) + " is not followed"),
                                                  HasSubstr("2 lines, the first is line 3"))))
        << call.call;
  }
}

TEST(GcodeProgram, SubprogramsAreNotDrawnWhereTheyStand) {
  const SampleTable table =
      gcode_table("o100 sub\nG1 X#1 Y7\nG1 X90 Y90\no100 endsub\nG1 X1 Y1\nX2\no100 call [4]\nM2\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 2));
  EXPECT_THAT(table.warnings, ElementsAre(HasSubstr("O CALL is not followed (line 7)"),
                                          HasSubstr("between O sub and O endsub are not drawn")));
}

TEST(GcodeProgram, MacrosArePassedOverAndSaidOnce) {
  const SampleTable table = gcode_table(
      "START_PRINT BED_TEMP=60 ; go\nSET_PRESSURE_ADVANCE ADVANCE=0.05\nG1 X1 Y1\nend_print\nX2\nT_MACRO2\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 2));
  EXPECT_THAT(table.warnings, ElementsAre(AllOf(HasSubstr("START_PRINT and other"),
                                                HasSubstr("4 lines, the first is line 1"))));
  for (const char* line : {"GX5", "XY", "GCODE=5", "XYZ5.5", "G1XYZ"})
    EXPECT_THAT(gcode_complaint(fmt::format("G1 X1 Y1\n{}\n", line)), HasSubstr("path.gcode:2: ")) << line;
}

TEST(GcodeProgram, LinesThatAControlMaySkipAreSaidToBeDrawn) {
  const SampleTable table = gcode_table("/G21\nG1 X1 Y1\n/G1 X500\nX2\n / X3\n");
  EXPECT_THAT(gcode_values(table, "x"), ElementsAre(1, 500, 2, 3));
  EXPECT_THAT(table.warnings,
              ElementsAre(AllOf(HasSubstr("begin with /"), HasSubstr("2 lines, the first is line 3"))));
}

TEST(GcodeProgram, CutsInTheMachinesCoordinatesAreSaidNotToBeDrawn) {
  for (const char* cut : {"G53 G1 X9 Y9", "G1 G53 X9", "G53 X9"})
    EXPECT_THAT(gcode_table(fmt::format("G1 X1 Y1\nX2\n{}\nG0 X5\nG1 X6\n", cut)).warnings,
                ElementsAre(AllOf(HasSubstr("G53 moves"), HasSubstr("cuts are not drawn (line 3)"))))
        << cut;
  for (const char* travel : {"G53 G0 X9 Y9", "G0 G53 X9", "G53 G1 Z9"})
    EXPECT_THAT(gcode_table(fmt::format("G1 X1 Y1\nX2\n{}\nG0 X5\nG1 X6\n", travel)).warnings, ElementsAre())
        << travel;
}

TEST(GcodeProgram, ANumberOfAProgramIsNoCall) {
  EXPECT_THAT(gcode_table("O1000\nG1 X1 Y1\nX2\n").warnings, ElementsAre());
}

}  // namespace
}  // namespace sandstroke
