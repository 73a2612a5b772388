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

TEST(GcodeProgram, ANumberOfAProgramIsNoCall) {
  EXPECT_THAT(gcode_table("O1000\nG1 X1 Y1\nX2\n").warnings, ElementsAre());
}

}  // namespace
}  // namespace sandstroke
